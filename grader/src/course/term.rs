//! The term in which a teacher gives the course: its name, its dates, its rule for late work.

use base::{GraderError, utc};
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use toml::value::{Datetime, Offset};

/// What `[term]` of `course.toml` says. First Light itself has none.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Term {
    /// The name of the teacher's course.
    pub name: String,
    /// When it is given, such as "Spring 2027".
    pub when: String,
    /// The dates of its parts.
    #[serde(default)]
    pub dates: Vec<PartDates>,
    /// What late work loses.
    #[serde(default)]
    pub late: Option<LateRule>,
}

/// The dates of a part.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PartDates {
    /// The part's number.
    pub part: u32,
    /// When it is handed out.
    pub opens: Option<Datetime>,
    /// When it has to be handed in.
    pub due: Option<Datetime>,
}

/// What late work loses.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LateRule {
    /// What is handed in so many minutes after the deadline is not late.
    #[serde(default)]
    pub grace_minutes: u32,
    /// The percentage of its points that late work loses for each day that begins.
    pub percent_per_day: f64,
    /// What is handed in more days late gives no points. Without it, points reach 0 by themselves.
    pub most_days: Option<u32>,
}

impl Term {
    /// "Computer graphics, Spring 2027".
    pub fn title(&self) -> String {
        format!("{}, {}", self.name, self.when)
    }

    /// The dates of a part.
    pub fn dates_of(&self, part: u32) -> Option<&PartDates> {
        self.dates.iter().find(|dates| dates.part == part)
    }

    /// When a part is due, in seconds since 1970; `None` if it has no date. A day alone lasts until
    /// its end in UTC.
    pub fn due(&self, part: u32) -> Option<i64> {
        seconds_of_due(&self.dates_of(part)?.due?)
    }

    /// The dates as a table in Markdown, and the rule for late work; empty if there are no dates.
    pub fn table(&self) -> String {
        if self.dates.is_empty() {
            return String::new();
        }
        let date = |date: &Option<Datetime>| date.map_or_else(String::new, |date| shown(&date));
        let mut text = "| part | handed out | due |\n|---|---|---|\n".to_string();
        for dates in &self.dates {
            let (opens, due) = (date(&dates.opens), date(&dates.due));
            let _ = writeln!(text, "| {} | {opens} | {due} |", dates.part);
        }
        if let Some(late) = &self.late {
            let _ = writeln!(text, "\n{}", late.sentences());
        }
        text
    }

    /// Returns an error if the rule or the dates make no sense.
    pub fn check(&self) -> Result<(), GraderError> {
        for dates in &self.dates {
            let due = dates
                .due
                .filter(|due| due.time.is_some() && due.offset.is_none());
            if let Some(due) = due {
                return Err(GraderError::new(format!(
                    "part {} is due {due}: a time of day needs its offset from UTC, such as {due}+01:00",
                    dates.part
                )));
            }
        }
        let Some(late) = self.late else { return Ok(()) };
        match (0.0..=100.0).contains(&late.percent_per_day) {
            true => Ok(()),
            false => Err(GraderError::new(format!(
                "`percent_per_day` is {}: expected a number from 0 to 100",
                late.percent_per_day
            ))),
        }
    }
}

impl LateRule {
    /// The rule in words for students.
    fn sentences(&self) -> String {
        let mut text = format!(
            "Late work loses {} % of its points for each day that begins after the deadline.",
            self.percent_per_day
        );
        if self.grace_minutes > 0 {
            let _ = write!(text, " The first {} minutes are free.", self.grace_minutes);
        }
        if let Some(days) = self.most_days {
            let _ = write!(text, " More than {days} days late it gets no points.");
        }
        text
    }
}

/// A deadline in seconds since 1970.
pub fn seconds_of_due(due: &Datetime) -> Option<i64> {
    let date = due.date?;
    let minutes = match due.offset {
        Some(Offset::Custom { minutes }) => i64::from(minutes),
        _ => 0,
    };
    let in_day = match due.time {
        Some(time) => {
            let second = i64::from(time.second.unwrap_or(0));
            (i64::from(time.hour) * 60 + i64::from(time.minute) - minutes) * 60 + second
        }
        None => 24 * 60 * 60 - 1,
    };
    let day = utc::start_of_day(date.year.into(), date.month.into(), date.day.into());
    Some(day + in_day)
}

/// A date for people: with a space between day and time, and without seconds that are 0.
fn shown(date: &Datetime) -> String {
    let text = date.to_string().replacen('T', " ", 1);
    text.replacen(":00Z", "Z", 1)
        .replacen(":00+", "+", 1)
        .replacen(":00-", "-", 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn term(text: &str) -> Term {
        toml::from_str(text).expect("a term")
    }

    #[test]
    fn dates_are_a_table() {
        let term = term(
            "name = \"Graphics\"\nwhen = \"Spring\"\ndates = [{ part = 1, opens = 2027-02-01, due = 2027-02-15T23:59:00+01:00 }, { part = 2 }]",
        );
        assert_eq!(term.title(), "Graphics, Spring");
        assert!(term.check().is_ok());
        assert_eq!(
            term.table(),
            "| part | handed out | due |\n|---|---|---|\n| 1 | 2027-02-01 | 2027-02-15 23:59+01:00 |\n| 2 |  |  |\n"
        );
    }

    #[test]
    fn deadlines_are_seconds_since_1970() {
        // As `date -u -d 2027-02-15T22:59:00Z +%s` prints them.
        for (due, seconds) in [
            ("1970-01-01T00:00:00Z", 0),
            ("2027-02-15T23:59:00+01:00", 1_802_732_340),
            ("2028-02-29T12:00:00-03:30", 1_835_451_000),
            ("2026-12-31", 1_798_761_599),
        ] {
            let term = term(&format!(
                "name = \"G\"\nwhen = \"S\"\ndates = [{{ part = 2, due = {due} }}]"
            ));
            assert_eq!(term.due(2), Some(seconds), "{due}");
            assert_eq!(term.due(1), None);
        }
    }

    #[test]
    fn a_time_without_an_offset_and_an_impossible_percentage_are_refused() {
        let head = "name = \"Graphics\"\nwhen = \"Spring\"\n";
        let time = term(&format!(
            "{head}dates = [{{ part = 1, due = 2027-02-15T23:59:00 }}]"
        ));
        let error = time.check().expect_err("no offset").to_string();
        assert!(
            error.contains("such as 2027-02-15T23:59:00+01:00"),
            "{error}"
        );
        let late = term(&format!("{head}[late]\npercent_per_day = 120"));
        assert!(late.check().is_err());
    }
}
