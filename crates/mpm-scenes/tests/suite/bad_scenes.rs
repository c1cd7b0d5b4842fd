//! Every bad scene gets an error with file, field and value.

use mpm_scenes::Scene;

use super::refusal::assert_refused;
use super::scenes::BLOCK;

#[test]
fn errors_name_the_file_the_field_and_the_value() {
    assert_refused(BLOCK, "block.toml", include_str!("../data/block_refused.toml"));
}

#[test]
fn a_file_that_is_not_there_is_an_error_with_its_name() {
    let message = Scene::read("no/such/scene.toml")
        .expect_err("there is none")
        .to_string();
    assert!(message.starts_with("no/such/scene.toml: cannot be read"), "{message}");
}
