//! A clock that other processes disturb less than that on the wall.

/// Processor time of the process in nanoseconds, which other processes disturb less; 0 where the system does not tell.
pub fn processor_time() -> f64 {
    let Ok(tasks) = std::fs::read_dir("/proc/self/task") else {
        return 0.0;
    };
    let of_task = |path: std::path::PathBuf| std::fs::read_to_string(path.join("schedstat")).ok();
    let times = tasks.filter_map(|task| of_task(task.ok()?.path()));
    times
        .filter_map(|text| text.split(' ').next()?.parse::<f64>().ok())
        .sum()
}
