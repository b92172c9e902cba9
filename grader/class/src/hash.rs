//! Hashes of files. They name units, so nobody may be able to construct two submissions with the
//! same hash: SHA-256.

use sha2::{Digest, Sha256};
use std::fmt::Write;

/// A hash in progress. Every part is hashed with its length, so that parts cannot be shifted into
/// each other.
#[derive(Clone, Default)]
pub struct Hasher(Sha256);

impl Hasher {
    /// Adds a part.
    pub fn part(&mut self, bytes: impl AsRef<[u8]>) -> &mut Hasher {
        let bytes = bytes.as_ref();
        self.0.update((bytes.len() as u64).to_le_bytes());
        self.0.update(bytes);
        self
    }

    /// The first 128 bits of the hash, as 32 hexadecimal digits: enough for names that nobody can
    /// make collide in practice, and short enough for a command line.
    pub fn finish(&self) -> String {
        let digest = self.0.clone().finalize();
        digest
            .iter()
            .take(16)
            .fold(String::new(), |mut text, byte| {
                let _ = write!(text, "{byte:02x}");
                text
            })
    }
}

/// The hash of some parts.
pub fn of<T: AsRef<[u8]>>(parts: impl IntoIterator<Item = T>) -> String {
    let mut hasher = Hasher::default();
    for part in parts {
        hasher.part(part);
    }
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_sha_256_of_lengths_and_parts() {
        // sha256("") = e3b0c442 98fc1c14 9afbf4c8 996fb924 ...
        assert_eq!(
            Hasher::default().finish(),
            "e3b0c44298fc1c149afbf4c8996fb924"
        );
        assert_ne!(of(["ab", "c"]), of(["a", "bc"]));
        assert_ne!(of(["a"]), of(["a", ""]));
        assert_eq!(of(["a", "b"]), of(["a", "b"]));
    }
}
