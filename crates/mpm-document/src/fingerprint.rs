/// A number by which contents are told apart: FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo), 64 bits.
pub fn fingerprint(content: &[u8]) -> u64 {
    let start = 0xcbf2_9ce4_8422_2325;
    content.iter().fold(start, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fingerprints_are_those_that_its_authors_publish() {
        assert_eq!(fingerprint(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fingerprint(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
