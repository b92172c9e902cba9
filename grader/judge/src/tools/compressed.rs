//! Compressed bytes: how the goldens of a handout, the signatures of mistakes and other files that
//! programs write for programs are stored. The format is lzip's, which holds length and checksum.

use lzma_rust2::{LzipOptions, LzipReader, LzipWriter};
use std::io::{Read, Write};

/// The level that compresses most.
const PRESET: u32 = 9;

/// The smallest dictionary. Unpacking needs memory for all of it, so it is hardly longer than what
/// is compressed.
const SMALLEST_DICTIONARY: usize = 1 << 16;

/// The largest size of an unpacked file. The largest of the course have 1.5 MB.
pub const MAX_UNPACKED: usize = 64 << 20;

/// Compresses bytes. The same bytes give the same result on every machine.
pub fn compress(plain: &[u8]) -> Vec<u8> {
    let mut options = LzipOptions::with_preset(PRESET);
    let length = plain.len().max(SMALLEST_DICTIONARY).next_power_of_two();
    let dictionary = &mut options.lzma_options.dict_size;
    *dictionary = u32::try_from(length).map_or(*dictionary, |length| length.min(*dictionary));
    let mut writer = LzipWriter::new(Vec::new(), options);
    let written = writer.write_all(plain).and_then(|()| writer.finish());
    written.expect("a vector takes all that is written")
}

/// Unpacks what [`compress`] returned, to at most `limit` bytes. The error says what is wrong with
/// `packed`.
pub fn decompress(packed: &[u8], limit: usize) -> Result<Vec<u8>, String> {
    let mut plain = Vec::new();
    let reader = LzipReader::new(packed);
    let read = reader.take(limit as u64 + 1).read_to_end(&mut plain);
    match read {
        Ok(_) if plain.len() > limit => Err(format!("it has more than {limit} bytes")),
        // An empty stream would be read as no bytes at all.
        Ok(_) if packed.is_empty() => Err("it is empty".into()),
        Ok(_) => Ok(plain),
        Err(error) => Err(error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text() -> Vec<u8> {
        let lines = (0..2000_u32).map(|i| format!("{} {}\n", i, i.wrapping_mul(2_654_435_761)));
        lines.collect::<String>().into_bytes()
    }

    #[test]
    fn compressed_bytes_are_shorter_and_are_unpacked() {
        for plain in [Vec::new(), b"a".to_vec(), vec![7; 300_000], text()] {
            let packed = compress(&plain);
            assert!(plain.len() < 100 || 2 * packed.len() < plain.len());
            assert_eq!(decompress(&packed, plain.len()), Ok(plain));
        }
    }

    #[test]
    fn what_is_longer_than_the_limit_is_an_error() {
        let packed = compress(&[7; 1000]);
        let error = decompress(&packed, 999).unwrap_err();
        assert_eq!(error, "it has more than 999 bytes");
    }

    #[test]
    fn no_damaged_byte_and_no_early_end_gives_other_bytes() {
        let plain = &text()[..3000];
        let packed = compress(plain);
        for end in 0..packed.len() {
            assert!(decompress(&packed[..end], 1 << 20).is_err(), "{end}");
        }
        // What says how long the dictionary is, and the last bits, do not matter.
        let damaged = (0..packed.len()).map(|at| {
            let mut damaged = packed.clone();
            damaged[at] ^= 0x02;
            decompress(&damaged, 1 << 20)
        });
        let unpacked: Vec<_> = damaged.flatten().collect();
        assert!(unpacked.len() < 8);
        assert!(unpacked.iter().all(|bytes| bytes == plain));
        assert!(decompress(b"text", 1 << 20).is_err());
    }
}
