//! What the worker uses of the machine, as Linux reports it.

use std::fs::File;
use std::io::{Read, Seek};

/// The file in which Linux shows it. It is opened before the worker gives up its rights.
pub(crate) struct UsageFile(Option<File>);

/// What a process uses; 0 where the system does not report it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Usage {
    pub(crate) threads: u64,
    /// Bytes of memory, the stacks of threads included.
    pub(crate) resident: u64,
}

impl UsageFile {
    /// The file of this process.
    pub(crate) fn open() -> UsageFile {
        UsageFile(File::open("/proc/self/status").ok())
    }

    /// What this process uses now.
    pub(crate) fn now(&mut self) -> Usage {
        let text = self.0.as_mut().and_then(text);
        text.as_deref().map(Usage::parse).unwrap_or_default()
    }
}

impl Usage {
    /// Reads the text of a file `status`, which has a line for each number.
    fn parse(status: &str) -> Usage {
        let number = |name: &str| {
            let mut lines = status.lines();
            let rest = lines.find_map(|line| line.strip_prefix(name)?.strip_prefix(':'));
            let number = rest.and_then(|rest| rest.split_whitespace().next()?.parse().ok());
            number.unwrap_or(0)
        };
        Usage {
            threads: number("Threads"),
            resident: number("VmRSS") << 10,
        }
    }
}

/// The whole text of a file, as it is now.
pub(crate) fn text(file: &mut File) -> Option<String> {
    let mut text = String::new();
    file.rewind().ok()?;
    file.read_to_string(&mut text).ok()?;
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_and_memory_are_read() {
        let status = "Name:\tworker\nVmHWM:\t  9000 kB\nVmRSS:\t  2048 kB\nThreads:\t3\n";
        let usage = Usage {
            threads: 3,
            resident: 2 << 20,
        };
        assert_eq!(Usage::parse(status), usage);
        assert_eq!(Usage::parse(""), Usage::default());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn this_process_has_threads_and_memory() {
        let usage = UsageFile::open().now();
        assert!(usage.threads >= 1 && usage.resident > 1 << 20, "{usage:?}");
    }
}
