//! What a good document says.

use mpm_scenes::scene::{BasisName, TransferKind, VectorTable};

use super::scenes::{BAR, BLOCK, CUBE, scene};

#[test]
fn good_scenes_are_read_with_their_defaults() {
    let bar = scene(BAR);
    assert_eq!(
        (
            bar.dimension,
            bar.grid.as_ref().map(|grid| grid.basis),
            bar.transfer.kind
        ),
        (1, Some(BasisName::Quadratic), TransferKind::Flip)
    );
    assert_eq!((bar.bodies[0].per_axis(), bar.time.damping), (2, 0.0));
    assert!(matches!(bar.bodies[0].velocity, Some(VectorTable::Field(_))));
    assert_eq!(
        scene(BLOCK).bodies[0].velocity,
        Some(VectorTable::Uniform(vec![1.0, 0.0]))
    );
    assert_eq!(scene(CUBE).time.courant, 0.3);
}
