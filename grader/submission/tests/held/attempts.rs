//! Ways out. Each returns whether it got out.

use std::fs::{self, File, FileTimes, OpenOptions};
use std::io::{ErrorKind, Read};
use std::net::{TcpListener, TcpStream, ToSocketAddrs, UdpSocket};
use std::os::fd::{AsFd, OwnedFd};
use std::os::unix::fs::{FileExt, PermissionsExt};
use std::os::unix::net::{UnixDatagram, UnixListener, UnixStream};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// A way out.
pub(crate) struct Attempt {
    pub(crate) name: &'static str,
    /// Gets the path of a socket that listens outside.
    pub(crate) got_out: fn(&Path) -> bool,
}

const fn attempt(name: &'static str, got_out: fn(&Path) -> bool) -> Attempt {
    Attempt { name, got_out }
}

pub(crate) const ALL: &[Attempt] = &[
    // Files.
    attempt("read the users", |_| fs::read("/etc/passwd").is_ok()),
    attempt("read its own program", |_| {
        std::env::current_exe().is_ok_and(|path| fs::read(path).is_ok())
    }),
    attempt("list the root", |_| fs::read_dir("/").is_ok()),
    attempt("list its folder", |_| fs::read_dir(".").is_ok()),
    attempt("ask whether a file exists", |_| {
        fs::metadata("/etc/passwd").is_ok()
    }),
    attempt("tell a file that exists from one that does not", |_| {
        let kind = |path| fs::metadata(path).map_err(|e| e.kind()).err();
        kind("/etc/passwd") != kind("/etc/no such file")
    }),
    attempt("write a file in its folder", |_| {
        fs::write("hostile", b"x").is_ok()
    }),
    attempt("write a file beside the socket", |socket| {
        fs::write(socket.with_file_name("hostile"), b"x").is_ok()
    }),
    attempt("make a folder", |socket| {
        fs::create_dir(socket.with_file_name("hostile")).is_ok()
    }),
    attempt("remove the socket", |socket| {
        fs::remove_file(socket).is_ok()
    }),
    attempt("rename the socket", |socket| {
        fs::rename(socket, socket.with_file_name("hostile")).is_ok()
    }),
    attempt("change the rights of a file", |socket| {
        fs::set_permissions(socket, fs::Permissions::from_mode(0o700)).is_ok()
    }),
    attempt("learn where it is", |_| {
        ["/proc/self/exe", "/proc/self/cwd", "/proc/self/fd/0"]
            .iter()
            .any(|path| fs::read_link(path).is_ok())
    }),
    attempt("learn from its arguments where it is", |_| {
        let mut arguments = std::env::args_os();
        arguments.any(|argument| argument.to_string_lossy().contains('/'))
    }),
    attempt("learn the real path of a file", |_| {
        fs::canonicalize("/etc/../etc/passwd").is_ok()
    }),
    attempt("list what it has open", |_| {
        fs::read_dir("/proc/self/fd").is_ok() || fs::read_dir("/dev/fd").is_ok()
    }),
    attempt("read the environment of its parent", |_| {
        let parent = std::os::unix::process::parent_id();
        fs::read(format!("/proc/{parent}/environ")).is_ok()
    }),
    attempt("read the keys of the machine", |_| {
        fs::read("/proc/keys").is_ok() || fs::read_dir("/root/.ssh").is_ok()
    }),
    attempt("make a link to what it may not read", |socket| {
        std::os::unix::fs::symlink("/etc/passwd", socket.with_file_name("hostile")).is_ok()
    }),
    attempt("make a second name of the socket", |socket| {
        fs::hard_link(socket, socket.with_file_name("hostile")).is_ok()
    }),
    attempt("change the owner of a file", |socket| {
        std::os::unix::fs::chown(socket, Some(0), Some(0)).is_ok()
    }),
    attempt("change the root", |_| {
        std::os::unix::fs::chroot("/").is_ok()
    }),
    attempt("make a pipe to wait at", |_| std::io::pipe().is_ok()),
    attempt("go to another folder", |_| {
        std::env::set_current_dir("/").is_ok()
    }),
    attempt("ask for its folder", |_| std::env::current_dir().is_ok()),
    // The memory of the worker, where the key is.
    attempt("open its memory", |_| File::open("/proc/self/mem").is_ok()),
    attempt("open its memory by the main thread's name", |_| {
        File::open(format!("/proc/self/task/{}/mem", std::process::id())).is_ok()
    }),
    attempt("open its memory on another thread", |_| {
        let open = || File::open("/proc/thread-self/mem").is_ok();
        std::thread::spawn(open).join().is_ok_and(|got_out| got_out)
    }),
    attempt("write its memory", |_| {
        OpenOptions::new()
            .write(true)
            .open("/proc/self/mem")
            .is_ok()
    }),
    attempt("read the map of its memory", |_| {
        fs::read("/proc/self/maps").is_ok()
    }),
    attempt("read what the worker reads about itself", |_| {
        fs::read("/proc/self/status").is_ok()
    }),
    attempt(
        "read the memory in a hook of another thread's panic",
        |_| {
            static SECRET: [u8; 8] = *b"a secret";
            static GOT_OUT: std::sync::atomic::AtomicBool =
                std::sync::atomic::AtomicBool::new(false);
            std::panic::set_hook(Box::new(|_| {
                let mut read = [0; 8];
                let memory = File::open("/proc/self/mem");
                let got = memory.and_then(|it| it.read_exact_at(&mut read, SECRET.as_ptr() as u64));
                GOT_OUT.store(got.is_ok(), std::sync::atomic::Ordering::SeqCst);
            }));
            let _ = std::thread::spawn(|| panic!()).join();
            let _ = std::panic::take_hook();
            GOT_OUT.load(std::sync::atomic::Ordering::SeqCst)
        },
    ),
    // Programs and processes.
    attempt("start a program", |_| {
        Command::new("/bin/true").status().is_ok()
    }),
    attempt("become another program", |_| {
        let _error = Command::new("/bin/true").exec();
        false
    }),
    attempt("become itself with all rights", |_| {
        let _error = Command::new(std::env::args_os().next().unwrap_or_default()).exec();
        false
    }),
    attempt("list the processes", |_| fs::read_dir("/proc").is_ok()),
    // Networks and sockets.
    attempt("send a datagram", |_| {
        UdpSocket::bind("127.0.0.1:0").is_ok()
    }),
    attempt("connect to a server", |_| {
        TcpStream::connect("127.0.0.1:22").is_err_and(|e| e.kind() != ErrorKind::PermissionDenied)
    }),
    attempt("be a server", |_| TcpListener::bind("127.0.0.1:0").is_ok()),
    attempt("look up a name", |_| {
        ("localhost", 80)
            .to_socket_addrs()
            .is_ok_and(|mut it| it.next().is_none())
    }),
    attempt("make a pair of sockets", |_| UnixStream::pair().is_ok()),
    attempt("make a pair of datagram sockets", |_| {
        UnixDatagram::pair().is_ok()
    }),
    attempt("send a datagram to a path", |socket| {
        let pair = UnixDatagram::pair()
            .or_else(|_| Ok::<_, ()>((channel_as_datagram(), channel_as_datagram())));
        pair.is_ok_and(|(one, _)| one.send_to(b"hostile", socket).is_ok())
    }),
    attempt("connect a datagram socket to a path", |socket| {
        channel_as_datagram().connect(socket).is_ok()
    }),
    attempt("learn from a socket whether a path exists", |_| {
        let error = |path| {
            channel_as_datagram()
                .connect(path)
                .map_err(|e| e.kind())
                .err()
        };
        error("/no such socket") != Some(ErrorKind::PermissionDenied)
    }),
    attempt("send a datagram to an address through the channel", |_| {
        UdpSocket::from(channel())
            .send_to(b"x", "127.0.0.1:9")
            .is_ok()
    }),
    attempt("connect the channel to a server", |_| {
        UdpSocket::from(channel()).connect("127.0.0.1:9").is_ok()
    }),
    attempt("wait for others at the channel", |_| {
        TcpListener::from(channel()).accept().is_ok()
            || UnixListener::from(channel()).accept().is_ok()
    }),
    attempt("ask the channel for an error", |_| {
        UnixStream::from(channel()).take_error().is_ok()
    }),
    attempt("send the log a line", |_| {
        channel_as_datagram().send_to(b"x", "/dev/log").is_ok()
    }),
    attempt("connect to a local service", |socket| {
        UnixStream::connect(socket).is_ok()
    }),
    attempt("be a local service", |socket| {
        UnixListener::bind(socket.with_file_name("hostile")).is_ok()
    }),
    attempt("be a local service for datagrams", |socket| {
        UnixDatagram::bind(socket.with_file_name("hostile")).is_ok()
    }),
    // The channel to the grader.
    attempt("read more of its channel", |_| {
        std::io::stdin()
            .read(&mut [0; 64])
            .is_ok_and(|read| read > 0)
    }),
    attempt("close the channel for the worker", |_| {
        UnixStream::from(channel())
            .shutdown(std::net::Shutdown::Both)
            .is_ok()
    }),
    attempt("make the channel give up early", |_| {
        UnixStream::from(channel()).set_nonblocking(true).is_ok()
    }),
    attempt("give the channel a time limit", |_| {
        UnixStream::from(channel())
            .set_write_timeout(Some(Duration::from_millis(1)))
            .is_ok()
    }),
    attempt("learn the name of the other end", |_| {
        UnixStream::from(channel()).peer_addr().is_ok()
    }),
    // What it has open.
    attempt("lock the output for others", |_| output().lock().is_ok()),
    attempt("empty the output", |_| output().set_len(0).is_ok()),
    attempt("change the times of the output", |_| {
        output().set_times(FileTimes::new()).is_ok()
    }),
    attempt("change the rights of the output", |_| {
        output()
            .set_permissions(fs::Permissions::from_mode(0o000))
            .is_ok()
    }),
    attempt("open the terminal", |_| File::open("/dev/tty").is_ok()),
    attempt("write the output to the disk", |_| {
        output().sync_all().is_ok()
    }),
    attempt("lock the channel for others", |_| {
        File::from(channel()).try_lock().is_ok()
    }),
];

/// Ways out that lead through files and networks: a level that closes these lets none of them pass,
/// even if it denies no system calls.
pub(crate) const THROUGH_FILES_AND_NETWORKS: &[Attempt] = &[
    attempt("read the users", |_| fs::read("/etc/passwd").is_ok()),
    attempt("read what the course has", |_| {
        fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml")).is_ok()
    }),
    attempt("list the home", |_| fs::read_dir("/root").is_ok()),
    attempt("write a file beside the socket", |socket| {
        fs::write(socket.with_file_name("hostile"), b"x").is_ok()
    }),
    attempt("replace its program", |_| {
        std::env::current_exe().is_ok_and(|path| fs::write(path, b"x").is_ok())
    }),
    attempt("remove the socket", |socket| {
        fs::remove_file(socket).is_ok()
    }),
    attempt("read the environment of another process", |_| {
        // In a space of processes of its own, these are its own, without a secret.
        let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
        let environments = entries.filter_map(|entry| fs::read(entry.path().join("environ")).ok());
        let mut secrets = environments.filter(|text| text.windows(5).any(|part| part == b"HOME="));
        secrets.next().is_some()
    }),
    attempt("connect to a local service", |socket| {
        UnixDatagram::unbound().is_ok_and(|one| one.send_to(b"hostile", socket).is_ok())
    }),
    attempt("see a network", |_| {
        // Only its own, where nobody listens and nothing is reached.
        UdpSocket::bind("127.0.0.1:0").is_ok_and(|socket| socket.connect("192.0.2.1:9").is_ok())
    }),
];

/// The worker's end of the channel, as safe code can get it.
fn channel() -> OwnedFd {
    let stdin = std::io::stdin();
    stdin
        .as_fd()
        .try_clone_to_owned()
        .expect("a descriptor can be copied")
}

fn channel_as_datagram() -> UnixDatagram {
    UnixDatagram::from(channel())
}

/// The pipe to which the code prints.
fn output() -> File {
    let stdout = std::io::stdout();
    File::from(
        stdout
            .as_fd()
            .try_clone_to_owned()
            .expect("a descriptor can be copied"),
    )
}
