//! Files that are shown one after the other.

use crate::escaped;

/// A `.pvd` file, the collection that ParaView opens to see files as one animation: the time of each and its name, which is taken relative to the collection.
pub fn collection<'a>(files: impl IntoIterator<Item = (f64, &'a str)>) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n",
    );
    for (time, file) in files {
        text.push_str(&format!(
            "    <DataSet timestep=\"{time:?}\" part=\"0\" file=\"{}\"/>\n",
            escaped(file)
        ));
    }
    text.push_str("  </Collection>\n</VTKFile>\n");
    text
}
