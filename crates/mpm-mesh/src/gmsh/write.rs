//! Writing `.msh` files.

use std::fmt::Write as _;

use super::element_types::simplex;
use crate::SimplexMesh;

/// Versions and encodings of `.msh` files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MshFormat {
    /// Version 2.2, text.
    Text22,
    /// Version 2.2, binary, little endian.
    Binary22,
    /// Version 4.1, text.
    Text41,
    /// Version 4.1, binary, little endian.
    Binary41,
}

/// The bytes of a `.msh` file of a mesh: tags are the numbers of vertices and cells plus one, positions are padded with
/// zeros to three coordinates, all in one entity of tag 1. Numbers in text are as short as they can be and read back to the same bits.
pub fn write_msh<const D: usize>(mesh: &SimplexMesh<D>, format: MshFormat) -> Vec<u8> {
    let header = match format {
        MshFormat::Text22 => "2.2 0 8",
        MshFormat::Binary22 => "2.2 1 8",
        MshFormat::Text41 => "4.1 0 8",
        MshFormat::Binary41 => "4.1 1 8",
    };
    let mut file = format!("$MeshFormat\n{header}\n").into_bytes();
    if matches!(format, MshFormat::Binary22 | MshFormat::Binary41) {
        file.extend(1i32.to_le_bytes());
        file.push(b'\n');
    }
    file.extend(b"$EndMeshFormat\n$Nodes\n");
    file.extend(nodes(mesh, format));
    file.extend(b"$EndNodes\n$Elements\n");
    file.extend(elements(mesh, format));
    file.extend(b"$EndElements\n");
    file
}

fn nodes<const D: usize>(mesh: &SimplexMesh<D>, format: MshFormat) -> Vec<u8> {
    let count = mesh.vertices().len();
    let position = |x: &[f64; D]| -> [f64; 3] { std::array::from_fn(|axis| x.get(axis).copied().unwrap_or(0.0)) };
    let positions = || mesh.vertices().iter().map(position);
    match format {
        MshFormat::Text22 => {
            let mut text = format!("{count}\n");
            for (tag, [x, y, z]) in (1u32..).zip(positions()) {
                line(&mut text, format_args!("{tag} {x:e} {y:e} {z:e}"));
            }
            text.into_bytes()
        }
        MshFormat::Binary22 => {
            let mut bytes = format!("{count}\n").into_bytes();
            for (tag, position) in (1i32..).zip(positions()) {
                bytes.extend(tag.to_le_bytes());
                bytes.extend(position.map(f64::to_le_bytes).as_flattened());
            }
            bytes.push(b'\n');
            bytes
        }
        MshFormat::Text41 => {
            let mut text = format!("1 {count} 1 {count}\n{D} 1 0 {count}\n");
            (1..=count).for_each(|tag| line(&mut text, format_args!("{tag}")));
            positions().for_each(|[x, y, z]| line(&mut text, format_args!("{x:e} {y:e} {z:e}")));
            text.into_bytes()
        }
        MshFormat::Binary41 => {
            let mut bytes = block_header([1, count, 1, count], [D as i32, 1, 0], count);
            bytes.extend((1..=count as u64).flat_map(u64::to_le_bytes));
            positions().for_each(|position| bytes.extend(position.map(f64::to_le_bytes).as_flattened()));
            bytes.push(b'\n');
            bytes
        }
    }
}

fn elements<const D: usize>(mesh: &SimplexMesh<D>, format: MshFormat) -> Vec<u8> {
    let count = mesh.cell_count();
    let (kind, _) = simplex(D);
    match format {
        MshFormat::Text22 | MshFormat::Text41 => {
            let (mut text, tags) = match format {
                MshFormat::Text22 => (format!("{count}\n"), format!(" {kind} 2 0 1")),
                _ => (format!("1 {count} 1 {count}\n{D} 1 {kind} {count}\n"), String::new()),
            };
            for (tag, cell) in (1u32..).zip(mesh.cells()) {
                let nodes: String = cell.iter().map(|vertex| format!(" {}", vertex + 1)).collect();
                line(&mut text, format_args!("{tag}{tags}{nodes}"));
            }
            text.into_bytes()
        }
        MshFormat::Binary22 => {
            let mut bytes = format!("{count}\n").into_bytes();
            bytes.extend([kind as i32, count as i32, 2].map(i32::to_le_bytes).as_flattened());
            for (tag, cell) in (1i32..).zip(mesh.cells()) {
                bytes.extend([tag, 0, 1].map(i32::to_le_bytes).as_flattened());
                bytes.extend(cell.iter().flat_map(|vertex| (vertex + 1).to_le_bytes()));
            }
            bytes.push(b'\n');
            bytes
        }
        MshFormat::Binary41 => {
            let mut bytes = block_header([1, count, 1, count], [D as i32, 1, kind as i32], count);
            for (tag, cell) in (1u64..).zip(mesh.cells()) {
                bytes.extend(tag.to_le_bytes());
                bytes.extend(cell.iter().flat_map(|vertex| (u64::from(*vertex) + 1).to_le_bytes()));
            }
            bytes.push(b'\n');
            bytes
        }
    }
}

/// What precedes the only block of a section of version 4.1: counts and bounds of tags, the entity, the block's count.
fn block_header(section: [usize; 4], entity: [i32; 3], count: usize) -> Vec<u8> {
    let mut bytes: Vec<u8> = section.iter().flat_map(|&size| (size as u64).to_le_bytes()).collect();
    bytes.extend(entity.map(i32::to_le_bytes).as_flattened());
    bytes.extend((count as u64).to_le_bytes());
    bytes
}

fn line(text: &mut String, content: std::fmt::Arguments) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{content}");
}
