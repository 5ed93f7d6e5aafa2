//! How much memory this process may still take, in one place.
//!
//! The least of three: what the machine has left; what the container has left, that is each cgroup
//! from this process's own up to the root (version 1 or 2); and what the limits of this process
//! (`ulimit -v` and `-d`) leave of its address space. An allocation that fails ends the program
//! with an abort, so what is going to be too much is refused before, in words.

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Who sets the least of the limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemoryLimit {
    /// The memory of the machine.
    Machine,
    /// That of the container, a control group.
    Container,
    /// The address space of a process, `ulimit -v`.
    AddressSpace,
    /// The data of a process, `ulimit -d`.
    Data,
    /// The system gave less than it had promised.
    System,
}

impl fmt::Display for MemoryLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Machine => "on this machine",
            Self::Container => "in this container (the limit of its control group)",
            Self::AddressSpace => "to this process (the limit of its address space, `ulimit -v`)",
            Self::Data => "to this process (the limit of its data, `ulimit -d`)",
            Self::System => "until the system refuses more",
        })
    }
}

/// More is needed than there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "the scene needs about {} of memory and {} are available {limit}; choose a larger \
     particle_spacing",
    bytes_for_people(*needed),
    bytes_for_people(*available)
)]
pub struct MemoryError {
    /// Bytes.
    pub needed: u64,
    /// Bytes.
    pub available: u64,
    /// Whose limit it is.
    pub limit: MemoryLimit,
}

/// Bytes in the unit that suits them: 512 bytes, 29 MiB, 3.2 GiB.
#[must_use]
pub fn bytes_for_people(bytes: u64) -> String {
    let mut value = bytes as f64;
    for unit in ["bytes", "KiB", "MiB", "GiB", "TiB"] {
        if value < 1024.0 {
            let digits = usize::from(value < 10.0 && unit != "bytes");
            return format!("{value:.digits$} {unit}");
        }
        value /= 1024.0;
    }
    format!("{value:.0} PiB")
}

/// Bytes of memory that this process can still take and whose limit that is, where it can be told.
#[must_use]
pub fn available_memory() -> Option<(u64, MemoryLimit)> {
    let mut system = sysinfo::System::new();
    system.refresh_memory();
    let machine = Some(system.available_memory()).filter(|&bytes| bytes > 0);
    let root = Path::new("/");
    let process = process_limits(root).into_iter();
    let others = process.chain(container(root).map(|bytes| (bytes, MemoryLimit::Container)));
    let machine = machine.map(|bytes| (bytes, MemoryLimit::Machine));
    machine
        .into_iter()
        .chain(others)
        .min_by_key(|(bytes, _)| *bytes)
}

/// Compares what is needed with what there is, before anything is allocated.
///
/// # Errors
/// It is more.
pub fn check(needed: u64) -> Result<(), MemoryError> {
    let refused = |available, limit| {
        Err(MemoryError {
            needed,
            available,
            limit,
        })
    };
    match available_memory() {
        Some((available, limit)) if needed > available => return refused(available, limit),
        _ => {}
    }
    // Limits that nobody reads here: the system is asked for the address space, which costs nothing
    // as long as nothing is written there.
    let mut space: Vec<u8> = Vec::new();
    let bytes = usize::try_from(needed).unwrap_or(usize::MAX);
    let given = space.try_reserve_exact(bytes);
    std::hint::black_box(&mut space);
    given.or_else(|_| {
        let available = available_memory().map_or(0, |(available, _)| available);
        refused(available.min(needed), MemoryLimit::System)
    })
}

/// Address space of a thread's stack.
const STACK: u64 = 2 << 20;

/// Address space that the allocator of glibc reserves for each thread that asks for memory. It
/// looks for twice as much at first, and does without where there is not so much.
const ARENA: u64 = 64 << 20;

/// What the program takes besides: buffers, the table of results.
const REST: u64 = 8 << 20;

/// What so many threads leave of the address space that is left now.
fn left_by(threads: u64, space: u64) -> u64 {
    let space = space.saturating_sub(threads.saturating_mul(STACK) + REST);
    let arenas = space.saturating_sub(threads.saturating_mul(ARENA));
    arenas.max(space.min(ARENA))
}

/// What the limits of this process leave, from `/proc` below `root`; nothing where none is set.
fn process_limits(root: &Path) -> Vec<(u64, MemoryLimit)> {
    let read = |name: &str| fs::read_to_string(root.join("proc/self").join(name)).ok();
    let (Some(limits), Some(status)) = (read("limits"), read("status")) else {
        return Vec::new();
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u64;
    let left = |limit: &str, used: &str| {
        let soft = limits.lines().find_map(|line| line.strip_prefix(limit))?;
        let soft: u64 = soft.split_whitespace().next()?.parse().ok()?;
        let used = status.lines().find_map(|line| line.strip_prefix(used))?;
        let kib: u64 = used.split_whitespace().next()?.parse().ok()?;
        Some(left_by(
            threads,
            soft.saturating_sub(kib.saturating_mul(1024)),
        ))
    };
    let space = left("Max address space", "VmSize:");
    let data = left("Max data size", "VmData:");
    let space = space.map(|bytes| (bytes, MemoryLimit::AddressSpace));
    let data = data.map(|bytes| (bytes, MemoryLimit::Data));
    space.into_iter().chain(data).collect()
}

/// The files of a version of cgroups: where they are mounted, the limit, what is taken, and which
/// of that is files which the kernel would rather forget.
struct Version {
    mounted: &'static str,
    limit: &'static str,
    taken: &'static str,
    files: &'static str,
}

const VERSION_1: Version = Version {
    mounted: "sys/fs/cgroup/memory",
    limit: "memory.limit_in_bytes",
    taken: "memory.usage_in_bytes",
    files: "total_inactive_file",
};

const VERSION_2: Version = Version {
    mounted: "sys/fs/cgroup",
    limit: "memory.max",
    taken: "memory.current",
    files: "inactive_file",
};

/// What the control groups of this process leave; `None` where none has a limit.
fn container(root: &Path) -> Option<u64> {
    let groups = fs::read_to_string(root.join("proc/self/cgroup")).unwrap_or_default();
    let mut least: Option<u64> = None;
    for line in groups.lines() {
        // Number of the hierarchy, controllers, path of the group.
        let mut parts = line.splitn(3, ':');
        let (Some(_), Some(controllers), Some(path)) = (parts.next(), parts.next(), parts.next())
        else {
            continue;
        };
        let version = match controllers {
            "" => VERSION_2,
            list if list.split(',').any(|name| name == "memory") => VERSION_1,
            _ => continue,
        };
        let mounted = root.join(version.mounted);
        // Within a container the path may be one of the host's; the root is then its own group.
        let own: PathBuf = mounted.join(path.trim_start_matches('/'));
        let up = own
            .ancestors()
            .take_while(|group| group.starts_with(&mounted));
        for bytes in up.filter_map(|group| left_in(group, &version)) {
            least = Some(least.map_or(bytes, |other| other.min(bytes)));
        }
    }
    least
}

/// What a control group leaves.
fn left_in(group: &Path, version: &Version) -> Option<u64> {
    let read = |name: &str| fs::read_to_string(group.join(name)).ok();
    let number = |name: &str| read(name)?.trim().parse::<u64>().ok();
    // `max`, which is no number, stands for no limit.
    let limit = number(version.limit)?;
    let taken = number(version.taken)?;
    let of_files = |text: String| {
        let mut lines = text.lines().filter_map(|line| line.split_once(' '));
        let (_, bytes) = lines.find(|(name, _)| *name == version.files)?;
        bytes.trim().parse::<u64>().ok()
    };
    let files = read("memory.stat").and_then(of_files).unwrap_or(0);
    Some(limit.saturating_sub(taken.saturating_sub(files)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file system with these files, which vanishes with its test.
    fn files(name: &str, files: &[(&str, &str)]) -> Tree {
        let unique = format!("loschmidt-memory-{}-{name}", std::process::id());
        let root = std::env::temp_dir().join(unique);
        for (path, text) in files {
            let path = root.join(path);
            fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            fs::write(path, text).expect("a file");
        }
        Tree(root)
    }

    struct Tree(PathBuf);

    impl Drop for Tree {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn the_tightest_group_from_the_own_to_the_root_counts() {
        let v2 = files(
            "v2",
            &[
                ("proc/self/cgroup", "0::/slice/scope\n"),
                ("sys/fs/cgroup/slice/memory.max", "1000000\n"),
                ("sys/fs/cgroup/slice/memory.current", "700000\n"),
                (
                    "sys/fs/cgroup/slice/memory.stat",
                    "anon 1\ninactive_file 100000\n",
                ),
                ("sys/fs/cgroup/slice/scope/memory.max", "max\n"),
                ("sys/fs/cgroup/slice/scope/memory.current", "600000\n"),
            ],
        );
        assert_eq!(container(&v2.0), Some(400_000));
        let v1 = files(
            "v1",
            &[
                (
                    "proc/self/cgroup",
                    "5:cpu:/a\n4:memory:/not/mounted/here\n0::/\n",
                ),
                ("sys/fs/cgroup/memory/memory.limit_in_bytes", "5000\n"),
                ("sys/fs/cgroup/memory/memory.usage_in_bytes", "9000\n"),
                (
                    "sys/fs/cgroup/memory/memory.stat",
                    "total_inactive_file 5000\n",
                ),
            ],
        );
        assert_eq!(container(&v1.0), Some(1000));
        let none = files("none", &[("proc/self/cgroup", "0::/\n")]);
        assert_eq!(container(&none.0), None);
    }

    #[test]
    fn limits_of_the_process_count_what_is_taken_and_what_threads_will_take() {
        let root = files(
            "process",
            &[
                (
                    "proc/self/limits",
                    "Limit                     Soft Limit           Hard Limit           Units\n\
                     Max data size             unlimited            unlimited            bytes\n\
                     Max address space         999999995904         unlimited            bytes\n",
                ),
                ("proc/self/status", "VmSize:\t 1000 kB\nVmData:\t 10 kB\n"),
            ],
        );
        let threads = std::thread::available_parallelism().map_or(1, usize::from) as u64;
        let left = 999_999_995_904 - 1_024_000 - REST - threads * (STACK + ARENA);
        // Where there is little, there are no arenas.
        let mebi = |n: u64| n << 20;
        assert_eq!(left_by(2, mebi(10)), 0);
        assert_eq!(left_by(2, mebi(42)), mebi(30));
        assert_eq!(left_by(2, mebi(112)), mebi(64));
        assert_eq!(left_by(2, mebi(500)), mebi(360));
        assert_eq!(process_limits(&root.0), [(left, MemoryLimit::AddressSpace)]);
    }

    #[test]
    fn what_is_too_much_is_refused_in_words() {
        let error = check(1 << 62).expect_err("four exbibytes");
        let text = error.to_string();
        assert!(text.contains("needs about 4096 PiB of memory"), "{text}");
        assert_eq!(check(1 << 20), Ok(()));
    }
}
