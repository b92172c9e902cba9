//! Values that programs store for programs: postcard, compressed.

use judge::compressed::{MAX_UNPACKED, compress, decompress};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Packs a value.
pub fn to_bytes(value: &impl Serialize) -> Result<Vec<u8>, String> {
    let plain = postcard::to_stdvec(value).map_err(|e| format!("it cannot be packed: {e}"))?;
    Ok(compress(&plain))
}

/// Unpacks what [`to_bytes`] packed. The error says what is wrong with the bytes.
pub fn from_bytes<T: DeserializeOwned>(packed: &[u8]) -> Result<T, String> {
    let plain =
        decompress(packed, MAX_UNPACKED).map_err(|e| format!("it cannot be unpacked: {e}"))?;
    let (value, rest) = postcard::take_from_bytes(&plain)
        .map_err(|e| format!("its contents have another form: {e}"))?;
    match rest.len() {
        0 => Ok(value),
        extra => Err(format!("{extra} bytes follow its contents")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_values_are_unpacked_and_other_bytes_are_not() {
        let value = (vec!["a".to_string()], 7_u32);
        let packed = to_bytes(&value).unwrap();
        assert_eq!(from_bytes(&packed), Ok(value));
        assert!(from_bytes::<u32>(b"text").is_err());
        assert!(from_bytes::<(Vec<String>, u32)>(&packed[..packed.len() - 1]).is_err());
        // A number, and nothing after it.
        let error = from_bytes::<u8>(&packed).unwrap_err();
        assert!(error.contains("bytes follow"), "{error}");
    }
}
