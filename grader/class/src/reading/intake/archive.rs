//! Reads zip, tar and tar.gz. The first bytes say which it is, whatever the file is called.

use super::unpack::Unpacker;
use crate::reading::Unreadable;
use crate::reading::content::unreadable;
use base::GraderError;
use flate2::read::MultiGzDecoder;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::Path;
use tar::EntryType;
use zip::ZipArchive;
use zip::result::ZipError;

/// The most bytes of a compressed tar file that are read through.
const MAX_STREAM: u64 = 2 << 30;

/// How many of the first bytes are read to find out the form.
const MAGIC: usize = 512;

/// The form of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Zip,
    Tar,
    TarGz,
    /// An archive that is not read, but that students use: its name.
    OtherArchive(&'static str),
    Pdf,
}

/// What to ask for instead of an [`OtherArchive`](Form::OtherArchive).
pub(super) const ASK_FOR: &str = "which is not read: ask for a zip, tar or tar.gz file";

/// The form of the file `path`; `None` if it is none of them.
pub(super) fn form(path: &Path) -> io::Result<Option<Form>> {
    // Only of regular files: opening a pipe waits for a writer.
    if !path.symlink_metadata()?.is_file() {
        return Ok(None);
    }
    let start = start_of(path)?;
    Ok(match &start {
        start if start.starts_with(b"PK\x03\x04") || start.starts_with(b"PK\x05\x06") => {
            Some(Form::Zip)
        }
        start if start.starts_with(&[0x1f, 0x8b]) => Some(Form::TarGz),
        start if start.get(257..262) == Some(b"ustar") => Some(Form::Tar),
        start if start.starts_with(b"%PDF") => Some(Form::Pdf),
        start => {
            let mut others = OTHERS.iter();
            let found = others.find(|(magic, _)| start.starts_with(magic));
            found.map(|(_, name)| Form::OtherArchive(name))
        }
    })
}

/// The archives that are not read: their first bytes and names.
const OTHERS: [(&[u8], &str); 5] = [
    (b"Rar!\x1a\x07", "RAR"),
    (b"7z\xbc\xaf\x27\x1c", "7z"),
    (b"\xfd7zXZ\0", "xz"),
    (b"BZh", "bzip2"),
    (b"\x28\xb5\x2f\xfd", "zstd"),
];

/// The first bytes of a file.
fn start_of(path: &Path) -> io::Result<Vec<u8>> {
    let mut start = Vec::new();
    let mut file = File::open(path)?.take(MAGIC as u64);
    file.read_to_end(&mut start)?;
    Ok(start)
}

/// Unpacks the file `path`.
pub(super) fn unpack(path: &Path, unpacker: &mut Unpacker) -> Result<(), Unreadable> {
    let failed = |e: io::Error| -> Unreadable { GraderError::file("read", path, e).into() };
    let Some(form) = form(path).map_err(failed)? else {
        let kind = path.symlink_metadata().map_err(failed)?;
        if kind.is_file() && kind.len() == 0 {
            return Err(Unreadable::Damaged(
                "is empty, a file of 0 bytes: the upload failed. Ask for it again".into(),
            ));
        }
        return Err(Unreadable::Damaged(
            "is neither a folder nor a zip, tar or tar.gz file".into(),
        ));
    };
    let file = BufReader::new(File::open(path).map_err(failed)?);
    let other = match form {
        Form::Zip => return unpack_zip(path, file, unpacker),
        Form::Tar => return unpack_tar(path, file.take(MAX_STREAM), unpacker),
        Form::TarGz => {
            return unpack_tar(path, MultiGzDecoder::new(file).take(MAX_STREAM), unpacker);
        }
        Form::OtherArchive(name) => name,
        Form::Pdf => "PDF",
    };
    Err(Unreadable::Damaged(format!(
        "is a file of the form {other}, {ASK_FOR}"
    )))
}

/// What is wrong with a part of an archive that cannot be read.
pub(super) fn damage(e: &io::Error) -> &'static str {
    match e.kind() {
        io::ErrorKind::UnexpectedEof => CUT,
        _ => "it was cut or changed on its way. Ask for it again",
    }
}

/// What is wrong with an archive whose end is missing.
const CUT: &str = "it ends too early, as after an upload that was cut. Ask for it again";

/// What the last part of a zip file begins with.
const END_OF_ZIP: &[u8] = b"PK\x05\x06";

/// The longest last part of a zip file, in bytes.
const MAX_END_OF_ZIP: u64 = 22 + 65_535;

/// Whether the zip file `path` has its last part.
fn has_end(path: &Path) -> io::Result<bool> {
    let mut file = File::open(path)?;
    let length = file.metadata()?.len();
    file.seek(SeekFrom::Start(length.saturating_sub(MAX_END_OF_ZIP)))?;
    let mut end = Vec::new();
    file.take(MAX_END_OF_ZIP).read_to_end(&mut end)?;
    Ok(end.windows(END_OF_ZIP.len()).any(|part| part == END_OF_ZIP))
}

/// The method by which an entry of a zip file is compressed.
fn method(number: u16) -> String {
    let name = match number {
        9 => "Deflate64",
        12 => "bzip2",
        14 => "LZMA",
        93 => "zstd",
        95 => "xz",
        _ => return format!("method number {number}"),
    };
    name.to_string()
}

fn unpack_zip(
    path: &Path,
    file: BufReader<File>,
    unpacker: &mut Unpacker,
) -> Result<(), Unreadable> {
    let damaged = |e: ZipError| {
        let why = match e {
            ZipError::UnsupportedArchive(ZipError::PASSWORD_REQUIRED) => {
                return Unreadable::Damaged("is encrypted: ask for it without a password".into());
            }
            ZipError::CompressionMethodNotSupported(number) => {
                return Unreadable::Damaged(format!(
                    "is a zip file compressed by {}, which is not read: ask for one that was made with the usual settings",
                    method(number)
                ));
            }
            ZipError::Io(e) => {
                return unreadable("read", path, &e, || {
                    format!("is a damaged zip file: {}", damage(&e))
                });
            }
            _ if matches!(has_end(path), Ok(false)) => CUT,
            _ => "its list of files cannot be read. Ask for one that was made anew",
        };
        Unreadable::Damaged(format!("is a damaged zip file: {why}"))
    };
    let mut archive = ZipArchive::new(file).map_err(damaged)?;
    for i in 0..archive.len() {
        let entry = archive.by_index(i).map_err(damaged)?;
        let name = entry.name().map_err(damaged)?.into_owned();
        let Some(path) = unpacker.path(&name)? else {
            continue;
        };
        if entry.is_symlink() {
            unpacker.link(&path);
        } else if !entry.is_dir() && unpacker.wants(&path, entry.size()) {
            unpacker.write(&path, entry)?;
        }
    }
    Ok(())
}

fn unpack_tar(path: &Path, stream: impl Read, unpacker: &mut Unpacker) -> Result<(), Unreadable> {
    let damaged = |e: io::Error| {
        match e.kind() {
        // A name may be as long as the archive says.
        io::ErrorKind::OutOfMemory => Unreadable::TooLarge(
            "is a tar file that cannot be unpacked within the limit of memory: ask for one that was made anew".into(),
        ),
        _ => unreadable("read", path, &e, || {
            format!("is a damaged tar file: {}", damage(&e))
        }),
    }
    };
    let mut archive = tar::Archive::new(stream);
    for entry in archive.entries().map_err(damaged)? {
        let entry = entry.map_err(damaged)?;
        let name = entry.path_bytes();
        let name = String::from_utf8_lossy(&name).into_owned();
        let kind = entry.header().entry_type();
        if matches!(kind, EntryType::XGlobalHeader | EntryType::XHeader) {
            continue;
        }
        let Some(path) = unpacker.path(&name)? else {
            continue;
        };
        match kind {
            EntryType::Regular | EntryType::Continuous => {
                if unpacker.wants(&path, entry.size()) {
                    unpacker.write(&path, entry)?;
                }
            }
            EntryType::Directory => {}
            // Links, and pipes and devices, which are no source files either.
            _ => unpacker.link(&path),
        }
    }
    Ok(())
}
