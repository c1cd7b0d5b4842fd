//! Frames for ParaView.

use mpm_scenes::output::vtu;
use mpm_scenes::{Snapshot, frames};

use crate::scenes::{HEAPS, scene};

fn snapshot() -> Snapshot {
    Snapshot {
        dimension: 2,
        time: 0.25,
        reference_positions: vec![0.0, 1.0, 2.0, 3.0],
        positions: vec![0.5, 1.0, 2.0, 3.5],
        velocities: vec![1.0, -1.0, 0.0, 2.0],
        stresses: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0],
        stresses_across: vec![9.0, 10.0],
        deformation_gradients: vec![1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 2.0],
        volume_ratios: vec![1.0, 2.0],
        masses: vec![0.5, 0.75],
        reference_volumes: vec![0.25, 0.5],
        bodies: vec![0, 1],
        materials: vec![1, 0],
        scalars: vec![("plastic_strain".into(), vec![0.0, 0.125])],
    }
}

/// The bytes of an array by its name, found as a reader finds them: offset, count of bytes, bytes.
fn array<'a>(file: &'a [u8], name: &str) -> &'a [u8] {
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let begin = file
        .windows(marker.len())
        .position(|window| window == marker)
        .expect("a block")
        + marker.len();
    let text = std::str::from_utf8(&file[..begin]).expect("text");
    let element = text
        .lines()
        .find(|line| line.contains(&format!("Name=\"{name}\"")))
        .expect("the array");
    let offset = element
        .split_once("offset=\"")
        .and_then(|(_, rest)| rest.split_once('"'))
        .expect("an offset")
        .0;
    let data = &file[begin + offset.parse::<usize>().expect("a number")..];
    let length = u64::from_le_bytes(data[..8].try_into().expect("eight bytes")) as usize;
    &data[8..8 + length]
}

fn floats(file: &[u8], name: &str) -> Vec<f64> {
    let words = array(file, name).chunks_exact(8);
    words
        .map(|word| f64::from_le_bytes(word.try_into().expect("eight bytes")))
        .collect()
}

#[test]
fn arrays_are_found_by_their_offsets() {
    let file = vtu(&snapshot());
    assert_eq!(floats(&file, "position"), [0.5, 1.0, 0.0, 2.0, 3.5, 0.0]);
    assert_eq!(floats(&file, "displacement"), [0.5, 0.0, 0.0, 0.0, 0.5, 0.0]);
    assert_eq!(
        floats(&file, "stress")[..9],
        [1.0, 2.0, 0.0, 3.0, 4.0, 0.0, 0.0, 0.0, 9.0]
    );
    assert_eq!(floats(&file, "pressure"), [-2.5, -6.5]);
    assert_eq!(floats(&file, "volume"), [0.25, 1.0]);
    assert_eq!(floats(&file, "plastic_strain"), [0.0, 0.125]);
    assert_eq!(array(&file, "types"), [1, 1]);
    assert_eq!(
        array(&file, "offsets"),
        [1i64.to_le_bytes(), 2i64.to_le_bytes()].as_flattened()
    );
    assert_eq!(
        array(&file, "material"),
        [1i64.to_le_bytes(), 0i64.to_le_bytes()].as_flattened()
    );
    assert!(file.ends_with(b"\n</AppendedData>\n</VTKFile>\n"));
}

/// In plane strain a fixed corotated solid has σ_zz = λ (J − 1), and of the laws side by side sand alone does not say what it has.
#[test]
fn frames_have_the_stress_across_the_plane() {
    let strip = include_str!("../../data/strip.toml").to_owned()
        + "velocity = { kind = \"sine\", amplitude = [1.0, 0.5], wave_vector = [1.5, 0.0] }\n";
    let (young, poisson) = (100.0, 0.3);
    let lame = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let mut largest = 0.0f64;
    frames(&scene(&strip), &mut |frame| {
        let file = vtu(&frame);
        let ratios = floats(&file, "volume_ratio");
        for (stress, ratio) in floats(&file, "stress").chunks_exact(9).zip(ratios) {
            largest = largest.max(stress[8].abs());
            assert!((stress[8] - lame * (ratio - 1.0)).abs() < 1e-12 * lame);
        }
    })
    .expect("runs");
    assert!(largest > 0.5, "{largest}");
    let mut last = Snapshot::default();
    frames(&scene(HEAPS), &mut |frame| last = frame).expect("runs");
    let across = |material: u32| {
        let of = last.materials.iter().zip(&last.stresses_across);
        of.filter(|(own, _)| **own == material)
            .fold(0.0f64, |most, (_, s)| most.max(s.abs()))
    };
    let names: Vec<bool> = (0..3).map(|material| across(material) > 0.0).collect();
    assert_eq!(names, [true, false, true], "metal, sand, water");
}
