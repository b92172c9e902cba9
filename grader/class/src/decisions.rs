//! What the teacher decides besides the course: who hands in together, by the roster, and the marks
//! by hand. `OUT/decided.json` has what the last tables were made with, so that changes are listed.

use crate::by_hand::{ByHand, Marks, given};
use crate::collect::Options;
use crate::out::{Out, read_regular};
use crate::plan::Plan;
use crate::roster::Roster;
use crate::roster::join::Join;
use base::{GraderError, write_whole};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use submission::Untrusted;

/// The decisions for a plan.
#[derive(Clone, Debug)]
pub struct Decisions {
    /// The roster, and whose each submission is.
    pub roster: Option<(Roster, Join)>,
    /// What is given by hand.
    pub by_hand: ByHand,
}

/// What `OUT/decided.json` has.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Decided {
    /// The marks of each submission and of single students.
    by_hand: BTreeMap<Untrusted, Marks>,
    /// The members of each team, if a roster was ever given.
    teams: Option<BTreeMap<Untrusted, Vec<Untrusted>>>,
}

impl Decisions {
    /// Reads the roster and `OUT/by_hand.csv`.
    pub fn read(out: &Out, plan: &Plan, roster: Option<&Path>) -> Result<Decisions, GraderError> {
        let read = roster.map(Roster::read).transpose()?;
        let roster = read.map(|roster| {
            let join = Join::of_plan(&roster, plan);
            (roster, join)
        });
        let joined = roster.as_ref().map(|(roster, join)| (roster, join));
        let by_hand = ByHand::read(out, plan, joined)?;
        Ok(Decisions { roster, by_hand })
    }

    /// What rows depend on.
    pub fn options(&self, plan: &Plan, options: Options) -> Options {
        let by_hand = self.by_hand.clone();
        let Some((roster, join)) = &self.roster else {
            return Options { by_hand, ..options };
        };
        let all = plan.submissions.iter().map(|planned| planned.name.raw());
        let names: Vec<&str> = all.collect();
        let replaced = join.replaced.iter().map(|(i, other)| {
            let why = format!("does not count: the team handed in {} later", names[*other]);
            (names[*i].to_string(), why.into())
        });
        Options {
            owners: join.names(roster, &names),
            replaced: replaced.collect(),
            by_hand,
            ..options
        }
    }

    /// Shows what changed since the last run, one sentence after the other, and then stores what the
    /// tables have now. A run that is killed in between shows it again.
    pub fn show_changes(&self, out: &Out, show: impl FnMut(String)) -> Result<(), GraderError> {
        let path = out.join("decided.json");
        let stored = read_regular(&path).ok();
        let parsed = stored.and_then(|stored| serde_json::from_slice(&stored).ok());
        let old: Decided = parsed.unwrap_or_default();
        let new = Decided {
            by_hand: self.marks(),
            teams: self.teams().or_else(|| old.teams.clone()),
        };
        if new != old {
            new.changes_since(&old).into_iter().for_each(show);
            let json = grader::report::json(&new)? + "\n";
            write_whole(&path, json.as_bytes())?;
        }
        Ok(())
    }

    fn marks(&self) -> BTreeMap<Untrusted, Marks> {
        let whole = self.by_hand.submissions.iter();
        let submissions = whole.map(|(name, marks)| (name.as_str().into(), marks.clone()));
        let members = self.by_hand.members.values().map(|member| {
            let name = format!("{} ({})", member.name.raw(), member.key.raw());
            (name.into(), member.marks.clone())
        });
        submissions.chain(members).collect()
    }

    fn teams(&self) -> Option<BTreeMap<Untrusted, Vec<Untrusted>>> {
        let (roster, _) = self.roster.as_ref()?;
        let mut teams: BTreeMap<Untrusted, Vec<Untrusted>> = BTreeMap::new();
        for student in roster
            .students
            .iter()
            .filter(|student| !student.team.is_empty())
        {
            let members = teams.entry(student.team.clone()).or_default();
            members.push(student.label().clone());
        }
        teams.values_mut().for_each(|members| members.sort());
        Some(teams)
    }
}

impl Decided {
    fn changes_since(&self, old: &Decided) -> Vec<String> {
        let both = [old, self];
        let marks = both.into_iter().flat_map(|decided| &decided.by_hand);
        let all = marks.flat_map(|(who, marks)| marks.keys().map(move |task| (who, task)));
        let keys: BTreeSet<(&Untrusted, &String)> = all.collect();
        let by_hand = keys.into_iter().filter_map(|(who, task)| {
            let of = both.map(|decided| decided.by_hand.get(who)?.get(task));
            let [a, b] = of.map(|mark| mark.map_or("nothing".into(), |mark| given(task, mark)));
            (of[0] != of[1]).then(|| format!("by hand: {}: {a} -> {b}", who.line()))
        });
        let mut changes: Vec<String> = by_hand.collect();
        // At first every team would be new.
        let (Some(old), Some(new)) = (&old.teams, &self.teams) else {
            return changes;
        };
        let teams: BTreeSet<&Untrusted> = old.keys().chain(new.keys()).collect();
        for team in teams {
            let of = [old, new].map(|teams| teams.get(team));
            let [a, b] = of.map(|members| {
                let members = members.into_iter().flatten().map(Untrusted::line);
                members
                    .reduce(|a, b| format!("{a}, {b}"))
                    .unwrap_or("nobody".into())
            });
            if of[0] != of[1] {
                changes.push(format!("team {}: {a} -> {b}", team.line()));
            }
        }
        changes
    }
}
