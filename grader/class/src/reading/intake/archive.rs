//! Reads zip, tar and tar.gz. The first bytes say which it is, whatever the file is called.

use super::unpack::Unpacker;
use crate::reading::Unreadable;
use base::GraderError;
use flate2::read::MultiGzDecoder;
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path;
use tar::EntryType;
use zip::ZipArchive;
use zip::result::ZipError;

/// The most bytes of a compressed tar file that are read through.
const MAX_STREAM: u64 = 2 << 30;

/// How many of the first bytes are read to find out the form.
const MAGIC: usize = 512;

/// The form of an archive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Zip,
    Tar,
    TarGz,
}

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
        _ => None,
    })
}

/// The name of a form that is not read, but that students use; `None` if it is none of them.
fn other_form(path: &Path) -> io::Result<Option<&'static str>> {
    let forms: [(&[u8], &str); 6] = [
        (b"Rar!\x1a\x07", "RAR"),
        (b"7z\xbc\xaf\x27\x1c", "7z"),
        (b"\xfd7zXZ\0", "xz"),
        (b"BZh", "bzip2"),
        (b"\x28\xb5\x2f\xfd", "zstd"),
        (b"%PDF", "PDF"),
    ];
    if !path.symlink_metadata()?.is_file() {
        return Ok(None);
    }
    let start = start_of(path)?;
    let found = forms.iter().find(|(magic, _)| start.starts_with(magic));
    Ok(found.map(|(_, name)| *name))
}

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
            match other_form(path).map_err(failed)? {
                Some(form) => format!(
                    "is a file of the form {form}, which is not read: ask for a zip, tar or tar.gz file"
                ),
                None => "is neither a folder nor a zip, tar or tar.gz file".into(),
            },
        ));
    };
    let file = BufReader::new(File::open(path).map_err(failed)?);
    match form {
        Form::Zip => unpack_zip(file, unpacker),
        Form::Tar => unpack_tar(file.take(MAX_STREAM), unpacker),
        Form::TarGz => unpack_tar(MultiGzDecoder::new(file).take(MAX_STREAM), unpacker),
    }
}

fn unpack_zip(file: BufReader<File>, unpacker: &mut Unpacker) -> Result<(), Unreadable> {
    let damaged = |e: ZipError| match e {
        ZipError::UnsupportedArchive(ZipError::PASSWORD_REQUIRED) => {
            Unreadable::Damaged("is encrypted: ask for it without a password".into())
        }
        e => Unreadable::Damaged(format!("is a damaged or unusual zip file: {e}")),
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

fn unpack_tar(stream: impl Read, unpacker: &mut Unpacker) -> Result<(), Unreadable> {
    let damaged = |e: io::Error| {
        match e.kind() {
        // A name may be as long as the archive says.
        io::ErrorKind::OutOfMemory => Unreadable::TooLarge(
            "is a tar file that cannot be unpacked within the limit of memory: ask for one that was made anew".into(),
        ),
        _ => Unreadable::Damaged(format!("is a damaged tar file: {e}")),
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
