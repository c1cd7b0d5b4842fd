//! Arrays of VTK XML files as raw appended data.

/// The block of data behind the text, and where each array begins in it.
#[derive(Default)]
pub struct Appended {
    /// The arrays, each behind the count of its bytes.
    pub bytes: Vec<u8>,
}

impl Appended {
    /// Adds an array; returns the element that describes it.
    pub fn array(&mut self, kind: &str, name: &str, components: usize, content: Vec<u8>) -> String {
        let offset = self.bytes.len();
        self.bytes.extend((content.len() as u64).to_le_bytes());
        self.bytes.extend(content);
        let name = name.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\"/>\n"
        )
    }

    pub fn floats(&mut self, name: &str, components: usize, values: &[f64]) -> String {
        let content = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.array("Float64", name, components, content)
    }

    pub fn integers(&mut self, name: &str, values: impl Iterator<Item = i64>) -> String {
        self.array("Int64", name, 1, values.flat_map(i64::to_le_bytes).collect())
    }
}
