//! Damage of bytes.

use crate::Random;

/// What bytes are replaced by: ends of ranges, where lengths and signs are decided.
const EXTREMES: [u8; 6] = [0, 1, 0x7f, 0x80, 0xfe, 0xff];

/// The most bytes that are repeated or removed at once.
const MOST: usize = 64;

/// Changes, removes, repeats, moves or inserts a few bytes, once or several times.
pub fn damage(bytes: &mut Vec<u8>, random: &mut Random) {
    for _ in 0..=random.below(3) {
        let at = random.below(bytes.len());
        let end = (at + random.below(MOST)).min(bytes.len());
        match random.below(8) {
            0 if at < bytes.len() => bytes[at] = random.number() as u8,
            1 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
            2 if at < bytes.len() => bytes[at] = *random.pick(&EXTREMES),
            // A whole number of four bytes.
            3 if at + 4 <= bytes.len() => bytes[at..at + 4].fill(*random.pick(&EXTREMES)),
            4 => bytes.truncate(at),
            5 => bytes.insert(at, *random.pick(&EXTREMES)),
            6 => drop(bytes.drain(at..end)),
            _ => {
                let again = bytes[at..end].to_vec();
                let to = random.below(bytes.len() + 1);
                bytes.splice(to..to, again);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damage_is_the_same_for_the_same_seed_and_of_every_kind() {
        let whole: Vec<u8> = (0..200).collect();
        let damaged = |seed| {
            let mut bytes = whole.clone();
            damage(&mut bytes, &mut Random::new(seed));
            bytes
        };
        let all: Vec<_> = (0..200).map(damaged).collect();
        assert_eq!(all, (0..200).map(damaged).collect::<Vec<_>>());
        let is_seen = |kind: fn(usize, usize) -> bool| {
            let mut changed = all.iter().filter(|damaged| **damaged != whole);
            changed.any(|damaged| kind(damaged.len(), whole.len()))
        };
        assert!(is_seen(|now, before| now < before));
        assert!(is_seen(|now, before| now > before));
        assert!(is_seen(|now, before| now == before));
        let mut nothing = Vec::new();
        (0..200).for_each(|seed| damage(&mut nothing, &mut Random::new(seed)));
    }
}
