//! Dates and times of day in UTC.
//!
//! The formulas are those of Howard Hinnant, "chrono-Compatible Low-Level Date Algorithms",
//! `civil_from_days` and `days_from_civil`: years begin in March, so that a leap day is the last
//! day of its year, and 400 years have 146,097 days.

/// The seconds of a day.
const DAY: i64 = 24 * 60 * 60;

/// The days of 400 years.
const DAYS_OF_ERA: i64 = 146_097;

/// The days from the 1st of March of the year 0 to the start of 1970.
const DAYS_TO_1970: i64 = 719_468;

/// A date of the Gregorian calendar and a time of day. Months and days count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Utc {
    pub year: i64,
    pub month: i64,
    pub day: i64,
    pub hour: i64,
    pub minute: i64,
    pub second: i64,
}

impl Utc {
    /// The time so many seconds after the start of 1970, or before it if they are negative.
    pub fn at(seconds: i64) -> Utc {
        let days = seconds.div_euclid(DAY) + DAYS_TO_1970;
        let of_day = seconds.rem_euclid(DAY);
        let (era, day_of_era) = (days.div_euclid(DAYS_OF_ERA), days.rem_euclid(DAYS_OF_ERA));
        let year_of_era =
            (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
        let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
        let from_march = (5 * day_of_year + 2) / 153;
        let month = (from_march + 2) % 12 + 1;
        Utc {
            year: era * 400 + year_of_era + i64::from(month <= 2),
            month,
            day: day_of_year - (153 * from_march + 2) / 5 + 1,
            hour: of_day / 3600,
            minute: of_day / 60 % 60,
            second: of_day % 60,
        }
    }
}

/// The start of a day in UTC, in seconds since the start of 1970. The month and the day count from
/// 1.
pub fn start_of_day(year: i64, month: i64, day: i64) -> i64 {
    let year = year - i64::from(month <= 2);
    let (era, year_of_era) = (year.div_euclid(400), year.rem_euclid(400));
    let day_of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    let day_of_era = year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
    (era * DAYS_OF_ERA + day_of_era - DAYS_TO_1970) * DAY
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_day_of_800_years_has_its_date_and_begins_where_it_should() {
        let mut day = start_of_day(1600, 1, 1);
        for year in 1600..2400 {
            let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
            let february = if is_leap { 29 } else { 28 };
            let lengths = [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
            for (month, length) in (1..).zip(lengths) {
                for date in 1..=length {
                    assert_eq!(start_of_day(year, month, date), day);
                    let last_second = Utc {
                        year,
                        month,
                        day: date,
                        hour: 23,
                        minute: 59,
                        second: 59,
                    };
                    assert_eq!(Utc::at(day + DAY - 1), last_second);
                    day += DAY;
                }
            }
        }
        assert_eq!(start_of_day(1970, 1, 1), 0);
    }
}
