//! Names of coordinates in files.

/// What coordinates are called beside columns or arrays called `others`: by `names`; x1,…,xD where there are none, and for a coordinate that is called like an earlier
/// one or one of the others. No two alike.
pub fn distinct_names(names: &[String], dimension: usize, others: &[&str]) -> Vec<String> {
    let mut taken: Vec<String> = others.iter().map(|&name| name.to_owned()).collect();
    let mut distinct = vec![String::new(); dimension];
    for (own, name) in distinct.iter_mut().zip(names) {
        if !taken.contains(name) {
            own.clone_from(name);
            taken.push(name.clone());
        }
    }
    for (axis, own) in distinct.iter_mut().enumerate().filter(|(_, own)| own.is_empty()) {
        *own = format!("x{}", axis + 1);
        while taken.contains(own) {
            own.push('_');
        }
        taken.push(own.clone());
    }
    distinct
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_coordinates_have_a_name() {
        let named = |names: &[&str]| {
            let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
            distinct_names(&names, names.len(), &["weight"]).join(" ")
        };
        assert_eq!(named(&["intercept", "intercept", "x1"]), "intercept x2 x1");
        assert_eq!(named(&["intercept", "x3", "weight"]), "intercept x3 x3_");
        assert_eq!(distinct_names(&[], 2, &[]), ["x1", "x2"]);
    }
}
