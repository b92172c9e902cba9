//! What a program may do, and how this is written as arguments of the launcher.

use std::ffi::OsString;
use std::path::PathBuf;

/// Everything that a program may do with files, processes and resources. Whatever is not listed is
/// denied: the network, and signals to other programs, always.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Policy {
    /// Files, and folders with everything in them, that may be read.
    pub read: Vec<PathBuf>,
    /// As `read`, and programs in them may be run.
    pub run: Vec<PathBuf>,
    /// Folders in which files may be read, written, created, removed and run.
    pub write: Vec<PathBuf>,
    /// Whether the program may start others, which then are limited in the same way.
    pub processes: bool,
    /// The user that the program runs as; the caller's if `None`. Only the superuser can change it.
    pub user: Option<u32>,
    /// Means of the system that it does not have, or that are not to be used.
    pub without: Without,
    /// Limits on resources.
    pub limits: Limits,
}

/// Means of the system that are left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Without {
    /// Landlock: files are not denied.
    pub landlock: bool,
    /// seccomp: system calls are not denied.
    pub seccomp: bool,
}

/// Limits on the resources of each process.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Limits {
    /// Processor time in seconds; unlimited if `None`.
    pub cpu_seconds: Option<u64>,
    /// Address space in megabytes; unlimited if `None`.
    pub memory_mb: Option<u64>,
    /// The largest file that may be written, in megabytes; unlimited if `None`.
    pub file_mb: Option<u64>,
    /// Threads of the user as whom the program runs, all its programs together; unlimited if `None`.
    /// It is of use for a user who runs nothing else.
    pub threads: Option<u64>,
}

impl Policy {
    /// The arguments that [`Policy::from_arguments`] reads. They end before the program.
    pub fn to_arguments(&self) -> Vec<OsString> {
        let mut arguments: Vec<OsString> = Vec::new();
        let lists = [
            ("--read", &self.read),
            ("--run", &self.run),
            ("--write", &self.write),
        ];
        for (name, paths) in lists {
            for path in paths {
                arguments.extend([name.into(), path.into()]);
            }
        }
        let numbers = [
            ("--user", self.user.map(u64::from)),
            ("--cpu-seconds", self.limits.cpu_seconds),
            ("--memory-mb", self.limits.memory_mb),
            ("--file-mb", self.limits.file_mb),
            ("--threads", self.limits.threads),
        ];
        for (name, number) in numbers {
            if let Some(number) = number {
                arguments.extend([name.into(), number.to_string().into()]);
            }
        }
        let words = [
            ("--processes", self.processes),
            ("--without-landlock", self.without.landlock),
            ("--without-seccomp", self.without.seccomp),
        ];
        let given = words.iter().filter(|(_, is_given)| *is_given);
        arguments.extend(given.map(|(word, _)| OsString::from(word)));
        arguments.push("--".into());
        arguments
    }

    /// Reads a policy. Returns it with the arguments after `--`: the program and its arguments.
    pub fn from_arguments(
        mut arguments: impl Iterator<Item = OsString>,
    ) -> Result<(Policy, Vec<OsString>), String> {
        let mut policy = Policy::default();
        while let Some(name) = arguments.next() {
            match name.to_str() {
                Some("--") => return Ok((policy, arguments.collect())),
                Some("--processes") => policy.processes = true,
                Some("--without-landlock") => policy.without.landlock = true,
                Some("--without-seccomp") => policy.without.seccomp = true,
                Some(name) => {
                    let value = arguments.next();
                    let value = value.ok_or_else(|| format!("{name} needs a value"))?;
                    policy.set(name, value)?;
                }
                None => return Err("the name of an option is not UTF-8".into()),
            }
        }
        Err("expected `--` and a program after the options".into())
    }

    fn set(&mut self, name: &str, value: OsString) -> Result<(), String> {
        let number = |value: OsString| {
            let number = value.to_str().and_then(|value| value.parse().ok());
            number.ok_or_else(|| format!("{name} is {value:?}: expected a whole number"))
        };
        match name {
            "--read" => self.read.push(value.into()),
            "--run" => self.run.push(value.into()),
            "--write" => self.write.push(value.into()),
            "--user" => {
                let user: u64 = number(value)?;
                let user = u32::try_from(user).map_err(|e| format!("--user is {user}: {e}"))?;
                self.user = Some(user);
            }
            "--cpu-seconds" => self.limits.cpu_seconds = Some(number(value)?),
            "--memory-mb" => self.limits.memory_mb = Some(number(value)?),
            "--file-mb" => self.limits.file_mb = Some(number(value)?),
            "--threads" => self.limits.threads = Some(number(value)?),
            _ => return Err(format!("there is no option {name}")),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_policy_is_read_back_from_its_arguments() {
        let policy = Policy {
            read: vec!["/a".into(), "/b c".into()],
            run: vec!["/r".into()],
            write: vec!["/w".into()],
            processes: true,
            user: Some(7),
            without: Without {
                landlock: true,
                seccomp: true,
            },
            limits: Limits {
                cpu_seconds: Some(1),
                memory_mb: None,
                file_mb: Some(3),
                threads: Some(5),
            },
        };
        let mut arguments = policy.to_arguments();
        arguments.extend(["program".into(), "--read".into()]);
        let read = Policy::from_arguments(arguments.into_iter());
        assert_eq!(read, Ok((policy, vec!["program".into(), "--read".into()])));
    }

    #[test]
    fn what_is_no_policy_is_an_error() {
        for (arguments, why) in [
            (&["--read"][..], "--read needs a value"),
            (
                &["--cpu-seconds", "x", "--"],
                "--cpu-seconds is \"x\": expected a whole number",
            ),
            (&["--colour", "x", "--"], "there is no option --colour"),
            (&[], "expected `--` and a program after the options"),
        ] {
            let read = Policy::from_arguments(arguments.iter().map(OsString::from));
            assert_eq!(read, Err(why.to_string()));
        }
    }
}
