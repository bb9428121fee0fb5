//! [`Shard`]: the share of a batch that one process draws, so that several computers can divide the work.
//!
//! The option `--shard K/N` sets it. In a job array, the environment variables of Slurm or Kubernetes do.

use std::fmt;

use crate::error::Error;

/// Every `count`-th item of a list, starting with item `first` (counted from 0).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shard {
    first: usize,
    count: usize,
}

/// Value of `--shard`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ShardSpec {
    /// Shard K of N: `2/4`.
    Given(Shard),
    /// Number of shards; the job array provides the index: `/4`.
    InJobArray(usize),
}

impl Shard {
    /// Whether item `number`, counted from 0, belongs to the shard.
    pub(crate) const fn has(self, number: usize) -> bool {
        number % self.count == self.first
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.first + 1, self.count)
    }
}

impl ShardSpec {
    /// Reads `K/N` or `/N`.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let share = text.split_once('/').and_then(|(k, n)| {
            let of: usize = n.parse().ok().filter(|of| *of > 0)?;
            if k.is_empty() {
                return Some(Self::InJobArray(of));
            }
            let k: usize = k.parse().ok().filter(|k| (1..=of).contains(k))?;
            Some(Self::Given(Shard { first: k - 1, count: of }))
        });
        share.ok_or_else(|| "write K/N, such as 1/4 for the first of four, or /4 in a job array".to_owned())
    }

    /// Resolves the shard, from the job array if necessary.
    ///
    /// # Errors
    /// If this process is not a task of a job array, or if the task number is out of range.
    pub(crate) fn shard(self) -> Result<Shard, Error> {
        match self {
            Self::Given(shard) => Ok(shard),
            Self::InJobArray(of) => numbered(of, &variable)?.ok_or_else(|| {
                Error::new("this is not a task of a job array: neither SLURM_ARRAY_TASK_ID nor JOB_COMPLETION_INDEX is set")
                    .at("--shard")
                    .remedy(format!("write the number of the shard, such as 1/{of}"))
            }),
        }
    }
}

/// Shard of this process in its job array; `None` outside a job array.
///
/// # Errors
/// If the environment does not define the number of tasks.
pub(crate) fn of_array() -> Result<Option<Shard>, Error> {
    counted(&variable)
}

/// Value of an environment variable; `None` if it is not set or empty.
fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok().filter(|value| !value.is_empty())
}

/// Number in an environment variable; `None` if it is not set.
fn number(name: &str, variable: &dyn Fn(&str) -> Option<String>) -> Result<Option<usize>, Error> {
    let Some(value) = variable(name) else { return Ok(None) };
    let number = value.trim().parse();
    let wrong = |_| Error::new(format!("`{value}` is not a number")).at(name).remedy("give --shard K/N");
    number.map(Some).map_err(wrong)
}

/// Shard of this task among `of` tasks; `None` outside a job array. Slurm must number its tasks from 1;
/// Kubernetes numbers them from 0.
fn numbered(of: usize, variable: &dyn Fn(&str) -> Option<String>) -> Result<Option<Shard>, Error> {
    let slurm = number("SLURM_ARRAY_TASK_ID", variable)?.map(|id| ("SLURM_ARRAY_TASK_ID", id, 1));
    let kubernetes = || number("JOB_COMPLETION_INDEX", variable);
    let found = match slurm {
        None => kubernetes()?.map(|index| ("JOB_COMPLETION_INDEX", index, 0)),
        found => found,
    };
    let Some((name, id, least)) = found else { return Ok(None) };
    let first = id.checked_sub(least).filter(|first| *first < of);
    let first = first.ok_or_else(|| {
        Error::new(format!("task {id} is outside {least} to {}", of - 1 + least))
            .at(name)
            .remedy(format!("number the tasks from {least} to {}, or give --shard K/N", of - 1 + least))
    })?;
    Ok(Some(Shard { first, count: of }))
}

/// Shard of this task, with the number of tasks taken from the environment; `None` outside a job array.
fn counted(variable: &dyn Fn(&str) -> Option<String>) -> Result<Option<Shard>, Error> {
    let number = |name| number(name, variable);
    let unsaid = |name: &str, missing: &str| {
        Err(Error::new(format!("this is a task of a job array, but {missing}"))
            .at(name)
            .remedy("give --shard /N with the number of tasks, or --shard 1/1 to draw all here"))
    };
    if let Some(id) = number("SLURM_ARRAY_TASK_ID")? {
        let name = "SLURM_ARRAY_TASK_ID";
        let Some(of) = number("SLURM_ARRAY_TASK_COUNT")?.filter(|of| *of > 0) else {
            return unsaid(name, "SLURM_ARRAY_TASK_COUNT is missing");
        };
        let min_id = number("SLURM_ARRAY_TASK_MIN")?.unwrap_or(1);
        let step = number("SLURM_ARRAY_TASK_STEP")?.unwrap_or(1).max(1);
        let max_id =
            number("SLURM_ARRAY_TASK_MAX")?.unwrap_or(min_id.saturating_add((of - 1).saturating_mul(step)));
        let index_of = |id: usize| id.checked_sub(min_id).filter(|off| off % step == 0).map(|off| off / step);
        // A list such as 3,7 has gaps, so the position of this task in it is unknown.
        return match index_of(id).filter(|first| *first < of && index_of(max_id) == Some(of - 1)) {
            Some(first) => Ok(Some(Shard { first, count: of })),
            None => unsaid(name, "its task numbers have gaps"),
        };
    }
    if let Some(first) = number("JOB_COMPLETION_INDEX")? {
        let name = "JOB_COMPLETION_INDEX";
        return match number("JOB_COMPLETIONS")? {
            Some(of) if first < of => Ok(Some(Shard { first, count: of })),
            Some(of) => unsaid(name, &format!("JOB_COMPLETIONS is {of}, and the index is not below it")),
            None => unsaid(name, "JOB_COMPLETIONS is missing"),
        };
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed_variables(line: &str) -> impl Fn(&str) -> Option<String> + '_ {
        |name| {
            line.split_whitespace().find_map(|pair| pair.strip_prefix(&format!("{name}=")).map(str::to_owned))
        }
    }

    #[test]
    fn shard_spec_numbers_shards_from_one() {
        assert_eq!(ShardSpec::parse("1/4"), Ok(ShardSpec::Given(Shard { first: 0, count: 4 })));
        assert_eq!(ShardSpec::parse("4/4"), Ok(ShardSpec::Given(Shard { first: 3, count: 4 })));
        assert_eq!(ShardSpec::parse("/4"), Ok(ShardSpec::InJobArray(4)));
        for wrong in ["0/4", "5/4", "1", "a/b", "1/0", "-1/2", "/0", "/"] {
            assert!(ShardSpec::parse(wrong).is_err(), "{wrong}");
        }
        let all: Vec<usize> = (0..10).filter(|n| Shard { first: 1, count: 4 }.has(*n)).collect();
        assert_eq!(all, [1, 5, 9]);
    }

    #[test]
    fn shard_is_read_from_the_variables_of_job_arrays() -> Result<(), Error> {
        let shard = |first, of| Some(Shard { first, count: of });
        assert_eq!(counted(&parsed_variables(""))?, None);
        let slurm = "SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_COUNT=4";
        assert_eq!(counted(&parsed_variables(slurm))?, shard(2, 4));
        assert_eq!(counted(&parsed_variables(&format!("{slurm} SLURM_ARRAY_TASK_MIN=0")))?, shard(3, 4));
        let odd = "SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=7 SLURM_ARRAY_TASK_STEP=2";
        assert_eq!(counted(&parsed_variables(&format!("{slurm} {odd}")))?, shard(1, 4));
        assert_eq!(counted(&parsed_variables("JOB_COMPLETION_INDEX=0 JOB_COMPLETIONS=4"))?, shard(0, 4));
        for wrong in [
            "SLURM_ARRAY_TASK_ID=3",
            "SLURM_ARRAY_TASK_ID=0 SLURM_ARRAY_TASK_COUNT=4",
            "SLURM_ARRAY_TASK_ID=7 SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_MIN=3 SLURM_ARRAY_TASK_MAX=7",
            "SLURM_ARRAY_TASK_ID=x SLURM_ARRAY_TASK_COUNT=2",
            "JOB_COMPLETION_INDEX=0",
            "JOB_COMPLETION_INDEX=4 JOB_COMPLETIONS=4",
        ] {
            assert!(counted(&parsed_variables(wrong)).is_err(), "{wrong}");
        }
        // A single task that is run again keeps its number.
        let again = "SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_COUNT=1 SLURM_ARRAY_TASK_MIN=3";
        assert_eq!(numbered(4, &parsed_variables(again))?, shard(2, 4));
        assert_eq!(numbered(4, &parsed_variables("JOB_COMPLETION_INDEX=3"))?, shard(3, 4));
        assert!(numbered(2, &parsed_variables(again)).is_err());
        assert_eq!(numbered(2, &parsed_variables(""))?, None);
        Ok(())
    }
}
