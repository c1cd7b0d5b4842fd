//! Some of many cases.

/// At most `most` of the numbers below `count`, evenly spaced up to the last.
pub(super) fn evenly(count: usize, most: usize) -> Vec<usize> {
    let used = count.min(most);
    (1..=used).map(|n| n * count / used - 1).collect()
}

/// At most `most` of the cases, far from one another: the one in the middle, then always the one that is farthest from those before it, with every parameter scaled to its range.
pub(super) fn spread(cases: &[Vec<f64>], most: usize) -> Vec<usize> {
    let parameters = 0..cases.first().map_or(0, Vec::len);
    let ranges = parameters.map(|k| {
        let values = || cases.iter().map(|case| case[k]);
        (
            values().fold(f64::INFINITY, f64::min),
            values().fold(f64::NEG_INFINITY, f64::max),
        )
    });
    let ranges: Vec<_> = ranges.collect();
    let scaled = |(value, &(least, largest)): (&f64, &(f64, f64))| {
        if largest > least {
            (value - least) / (largest - least)
        } else {
            0.5
        }
    };
    let places = cases.iter().map(|case| case.iter().zip(&ranges).map(scaled).collect());
    let places: Vec<Vec<f64>> = places.collect();
    let distance = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
    let middle = vec![0.5; ranges.len()];
    let from_middle = |case: &usize| distance(&places[*case], &middle);
    let first = (0..cases.len()).min_by(|a, b| from_middle(a).total_cmp(&from_middle(b)));
    let mut chosen: Vec<usize> = first.into_iter().collect();
    while chosen.len() < most.min(cases.len()) {
        let apart = |case: &usize| {
            chosen
                .iter()
                .map(|&other| distance(&places[*case], &places[other]))
                .fold(f64::INFINITY, f64::min)
        };
        let free = (0..cases.len()).filter(|case| !chosen.contains(case));
        let Some(next) = free.max_by(|a, b| apart(a).total_cmp(&apart(b))) else {
            break;
        };
        chosen.push(next);
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn cases_are_spread_over_the_parameters_and_not_over_their_list() {
        let cases = [[2.0, 0.0], [0.0, 0.0], [0.8, 0.12], [1.1, 0.0], [0.0, 0.2]].map(Vec::from);
        assert_eq!(spread(&cases, 3), [2, 0, 1]);
        assert_eq!(spread(&cases, 9).len(), 5, "each once");
        assert_eq!(spread(&[vec![3.0], vec![3.0]], 3).len(), 2, "equal ones, too");
        assert_eq!(spread(&[vec![], vec![]], 1), [0], "without parameters");
        assert!(spread(&[], 3).is_empty());
    }
}
