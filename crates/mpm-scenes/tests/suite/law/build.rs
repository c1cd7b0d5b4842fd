//! Laws from their tables.

use mpm_materials::Memory;
use mpm_scenes::SceneFault;
use mpm_scenes::law::{AnyLaw, build};
use mpm_scenes::scene::MaterialTable;
use mpm_tensor::Matrix;

fn metal(keys: &str) -> Result<AnyLaw<2>, SceneFault> {
    let solid =
        "law = \"softening-hencky\"\ndensity = 1.0\nyoung_modulus = 10.0\npoisson_ratio = 0.3\nsoftening_rate = 2.0\n";
    let table: MaterialTable = toml::from_str(&format!("{solid}{keys}")).expect("a table");
    build("materials.metal", &table)
}

#[test]
fn strengths_are_counted_in_norms_of_the_stress() {
    let sheared = |keys| {
        let mut memory = Memory::default();
        let law = metal(keys).expect("a law");
        (law.advance(&Matrix([[1.0, 0.3], [0.0, 1.0]]), &mut memory), memory)
    };
    let scaled = sheared("norm_per_strength = 0.5\npeak_yield_stress = 0.4\nresidual_yield_stress = 0.2\n");
    assert!(scaled.1.0[0] > 0.0);
    assert_eq!(
        scaled,
        sheared("peak_yield_stress = 0.2\nresidual_yield_stress = 0.1\n")
    );
    for bad in ["0.0", "-1.0", "nan", "inf"] {
        let error = metal(&format!("norm_per_strength = {bad}\npeak_yield_stress = 0.4\n"));
        let error = error.err().expect("refused").to_string();
        assert!(error.starts_with("materials.metal.norm_per_strength"), "{error}");
    }
}

#[test]
fn snow_is_fresh_unless_said_and_errors_name_its_key() {
    let solid = "law = \"snow\"\ndensity = 400.0\nyoung_modulus = 1.4e5\npoisson_ratio = 0.2\n";
    let table = |keys: &str| toml::from_str::<MaterialTable>(&format!("{solid}{keys}")).expect("a table");
    let mut memory = Memory::default();
    let law = build::<2>("materials.snow", &table("")).expect("a law");
    let pressed = law.advance(&(Matrix::IDENTITY * 0.9), &mut memory);
    assert!((pressed - Matrix::IDENTITY * 0.975).maximum_norm() < 1e-15);
    assert_eq!(law.internal_variables(), ["log_plastic_volume"]);
    for (key, value) in [
        ("critical_compression", "1.0"),
        ("critical_stretch", "0.0"),
        ("hardening", "-1.0"),
    ] {
        let error = build::<2>("materials.snow", &table(&format!("{key} = {value}\n")));
        let error = error.err().expect("refused").to_string();
        assert!(error.contains(&format!("materials.snow.{key}")), "{error}");
    }
}
