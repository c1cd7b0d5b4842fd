//! What all benchmarks begin with.

/// One thread, or as many as `RAYON_NUM_THREADS` says.
pub fn one_thread_unless_told() {
    let threads = std::env::var("RAYON_NUM_THREADS").map_or(1, |n| n.parse().expect("a number of threads"));
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global()
        .expect("the first pool");
}
