/// A number by which contents are told apart: FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo), 64 bits.
pub(crate) fn fingerprint(content: &[u8]) -> u64 {
    let start = 0xcbf2_9ce4_8422_2325;
    content.iter().fold(start, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
