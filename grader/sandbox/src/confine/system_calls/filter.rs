//! A list of system calls, as a program of the kernel's filter.

use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, TargetArch, apply_filter,
};
use std::collections::BTreeMap;

/// Programs of the x32 ABI call the same calls by numbers with this bit.
#[cfg(target_arch = "x86_64")]
pub(super) const X32_BIT: i64 = 0x4000_0000;

/// System calls; those with rules, only with such arguments.
#[derive(Default)]
pub(super) struct Calls(BTreeMap<i64, Vec<SeccompRule>>);

/// A condition on an argument: its number, how it is compared, and with what.
pub(super) type Condition = (u8, SeccompCmpOp, u64);

impl Calls {
    /// Adds `calls` with any arguments.
    pub(super) fn all(&mut self, calls: &[i64]) {
        for call in calls {
            self.0.insert(*call, Vec::new());
        }
    }

    /// Adds the numbers by which programs of the x32 ABI make the calls of the list.
    pub(super) fn of_x32_too(&mut self) {
        #[cfg(target_arch = "x86_64")]
        {
            let doubled: Vec<_> = self
                .0
                .iter()
                .map(|(call, rules)| (*call | X32_BIT, rules.clone()))
                .collect();
            self.0.extend(doubled);
        }
    }

    /// Adds `call` with arguments that meet these conditions, which compare the lower 32 bits.
    pub(super) fn with(&mut self, call: i64, conditions: &[Condition]) -> Result<(), String> {
        self.with_length(call, conditions, SeccompCmpArgLen::Dword)
    }

    /// Adds `call` with an argument number `argument` that is a null pointer.
    pub(super) fn with_null(&mut self, call: i64, argument: u8) -> Result<(), String> {
        let is_null = [(argument, SeccompCmpOp::Eq, 0)];
        self.with_length(call, &is_null, SeccompCmpArgLen::Qword)
    }

    fn with_length(
        &mut self,
        call: i64,
        conditions: &[Condition],
        length: SeccompCmpArgLen,
    ) -> Result<(), String> {
        let conditions: Result<Vec<_>, _> = conditions
            .iter()
            .cloned()
            .map(|(argument, compare, value)| {
                SeccompCondition::new(argument, length.clone(), compare, value)
            })
            .collect();
        let rule = conditions.and_then(SeccompRule::new);
        self.0.entry(call).or_default().push(rule.map_err(failed)?);
        Ok(())
    }

    /// The filter that lets these calls fail with `error` and allows all others.
    pub(super) fn denied_with(mut self, error: i32) -> Result<BpfProgram, String> {
        self.of_x32_too();
        self.compile(
            SeccompAction::Allow,
            SeccompAction::Errno(error.unsigned_abs()),
        )
    }

    /// The filter that allows these calls and lets all others fail with `error`.
    pub(super) fn allowed_or(self, error: i32) -> Result<BpfProgram, String> {
        self.compile(
            SeccompAction::Errno(error.unsigned_abs()),
            SeccompAction::Allow,
        )
    }

    fn compile(self, others: SeccompAction, these: SeccompAction) -> Result<BpfProgram, String> {
        let machine = TargetArch::try_from(std::env::consts::ARCH).map_err(failed)?;
        let filter = SeccompFilter::new(self.0, others, these, machine);
        filter.and_then(BpfProgram::try_from).map_err(failed)
    }
}

/// Applies a filter to this thread, and to those that it will start.
pub(super) fn apply(filter: &BpfProgram) -> Result<(), String> {
    apply_filter(filter).map_err(failed)
}

fn failed(why: impl std::fmt::Display) -> String {
    format!("seccomp: {why}")
}
