//! Asks questions, reads the answers and prints what is right.

use super::draw::Draw;
use super::number;
use super::questions::Question;
use super::store::Answer;
use super::worked_examples::{AskedNumber, WorkedExample};
use crate::report::wrap::wrap;
use base::GraderError;
use std::io::BufRead;

/// The letters before choices.
const LETTERS: [char; 6] = ['a', 'b', 'c', 'd', 'e', 'f'];

/// The line that ends the questions.
pub const QUIT: &str = "q";

/// Where answers come from and where the text goes.
pub struct Session<'a> {
    /// A line for each answer.
    pub input: &'a mut dyn BufRead,
    /// Prints a text.
    pub print: &'a mut dyn FnMut(&str),
    /// Whether to print the answers, too: those of a file or another program are not on the screen.
    pub echoes: bool,
    /// The width of the text in columns.
    pub width: usize,
    /// Whether [`QUIT`] was typed.
    pub has_quit: bool,
}

impl Session<'_> {
    /// Asks all questions. A line that is neither a choice nor a number is asked for again; an
    /// empty line skips the question. At the end of the input or after [`QUIT`], the answers so far
    /// are returned.
    pub fn run(
        &mut self,
        questions: &[Question],
        example: Option<&WorkedExample>,
        seed: u64,
    ) -> Result<Vec<Answer>, GraderError> {
        let mut answers = Vec::new();
        for (i, question) in questions.iter().enumerate() {
            let Some(answer) = self.choice(i + 1, question, seed)? else {
                return Ok(answers);
            };
            answers.push(answer);
        }
        if let Some(example) = example {
            self.say("\nThe worked example, with numbers of your own:");
            for line in &example.given {
                self.say(&format!("  {line}"));
            }
            for asked in &example.asked {
                let Some(answer) = self.number(asked)? else {
                    return Ok(answers);
                };
                answers.push(answer);
            }
        }
        Ok(answers)
    }

    /// Asks one question; `None` if the input has ended, also by [`QUIT`].
    pub fn choice(
        &mut self,
        number: usize,
        question: &Question,
        seed: u64,
    ) -> Result<Option<Answer>, GraderError> {
        self.say(&format!("\n{number}. {}", question.text));
        let order = shuffled(question.choices.len(), seed, number as u32);
        for (letter, &at) in LETTERS.iter().zip(&order) {
            self.say(&format!("   {letter}) {}", question.choices[at].text));
        }
        self.ask("   > ", &question.text, |typed| {
            judge_choice(question, &order, typed)
        })
    }

    fn number(&mut self, asked: &AskedNumber) -> Result<Option<Answer>, GraderError> {
        let prompt = format!("  {} = ", asked.name);
        self.ask(&prompt, asked.name, |typed| judge_number(asked, typed))
    }

    /// Asks until `judge` accepts a line as an answer; `None` if the input has ended, also by
    /// [`QUIT`].
    fn ask(
        &mut self,
        prompt: &str,
        question: &str,
        judge: impl Fn(&str) -> Result<Reply, String>,
    ) -> Result<Option<Answer>, GraderError> {
        while let Some(typed) = self.line(prompt)? {
            match judge(&typed) {
                Ok(Reply { text, is_right }) => {
                    self.say(&format!("   {text}"));
                    return Ok(Some(Answer {
                        question: question.into(),
                        typed,
                        is_right,
                    }));
                }
                Err(expected) => self.say(&format!(
                    "   expected {expected}, an empty line to skip, or `{QUIT}` to end; found `{typed}`"
                )),
            }
        }
        Ok(None)
    }

    /// The next line of the input; `None` at its end or for [`QUIT`].
    fn line(&mut self, prompt: &str) -> Result<Option<String>, GraderError> {
        let failed =
            |e: std::io::Error| GraderError::new(format!("cannot read the standard input: {e}"));
        (self.print)(prompt);
        let mut line = String::new();
        let is_end = self.input.read_line(&mut line).map_err(failed)? == 0;
        if is_end {
            return Ok(None);
        }
        let typed = line.trim().to_string();
        if self.echoes {
            (self.print)(&format!("{typed}\n"));
        }
        self.has_quit = typed == QUIT;
        Ok((!self.has_quit).then_some(typed))
    }

    /// Prints a paragraph.
    pub fn say(&mut self, text: &str) {
        let (start, indent) = match text.strip_prefix('\n') {
            Some(_) => ("\n", 3),
            None => ("", text.len() - text.trim_start().len()),
        };
        let mut all = start.to_string();
        for line in wrap(text.trim_start_matches('\n'), indent, self.width) {
            all += &line;
            all.push('\n');
        }
        (self.print)(&all);
    }
}

/// What is printed after an answer.
struct Reply {
    text: String,
    is_right: bool,
}

/// Judges a letter for one of the choices in the shown `order`. The error is what is expected.
fn judge_choice(question: &Question, order: &[usize], typed: &str) -> Result<Reply, String> {
    let letters = &LETTERS[..order.len()];
    let mut chars = typed.chars();
    let letter = chars.next().map(|letter| letter.to_ascii_lowercase());
    let place = letters.iter().position(|known| Some(*known) == letter);
    let (text, is_right) = match (place, chars.as_str()) {
        _ if typed.is_empty() => ("Skipped.".into(), false),
        (Some(place), "" | ")") => match &question.choices[order[place]].why_not {
            None => ("Right.".into(), true),
            Some(why) => {
                let right = &question.choices[0].text;
                (format!("No. {why} Right is: {right}"), false)
            }
        },
        _ => {
            let last = letters[letters.len() - 1];
            return Err(format!("a letter from a to {last}"));
        }
    };
    Ok(Reply { text, is_right })
}

/// Judges a number. The error is what is expected.
fn judge_number(asked: &AskedNumber, typed: &str) -> Result<Reply, String> {
    let truth = number::shown(asked.truth);
    let (text, is_right) = match number::parse(typed) {
        _ if typed.is_empty() => (format!("Skipped. It is {truth}."), false),
        None => return Err("a number such as 0.25 or 1/4".into()),
        Some(value) if number::is_near(value, asked.truth) => ("Right.".into(), true),
        Some(value) => match asked.mistake(value) {
            Some(what) => (format!("No: that is {what}. It is {truth}."), false),
            None => (format!("No, it is {truth}."), false),
        },
    };
    Ok(Reply { text, is_right })
}

/// The numbers from 0 to `count - 1` in the order of this seed and question.
fn shuffled(count: usize, seed: u64, question: u32) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    Draw::of([question, 0], seed).shuffle(&mut order);
    order
}

#[cfg(test)]
mod tests {
    use super::super::questions::Choice;
    use super::super::worked_examples;
    use super::*;

    fn question() -> Question {
        let choice = |text: &str, why: Option<&str>| Choice {
            text: text.into(),
            why_not: why.map(String::from),
        };
        Question {
            text: "Is it?".into(),
            choices: vec![
                choice("It is.", None),
                choice("It is not.", Some("It was.")),
                choice("Who knows?", Some("You.")),
            ],
        }
    }

    fn run(input: &str, example: Option<&WorkedExample>) -> (String, Vec<Answer>) {
        let mut text = String::new();
        let mut session = Session {
            input: &mut input.as_bytes(),
            print: &mut |more| text.push_str(more),
            echoes: false,
            width: 200,
            has_quit: false,
        };
        let answers = session
            .run(&[question()], example, 3)
            .expect("the input can be read");
        (text, answers)
    }

    /// The letter of choice number `choice` for the seed of [`run`].
    fn letter(choice: usize) -> char {
        let place = shuffled(3, 3, 1).iter().position(|at| *at == choice);
        LETTERS[place.expect("all are shown")]
    }

    #[test]
    fn choices_are_right_or_have_a_reason() {
        let (text, answers) = run(&format!("{}\n", letter(0)), None);
        assert!(text.contains("Right."), "{text}");
        assert!(answers[0].is_right);
        let (text, answers) = run(&format!("{})\n", letter(1).to_ascii_uppercase()), None);
        assert!(text.contains("No. It was. Right is: It is."), "{text}");
        assert!(!answers[0].is_right);
    }

    #[test]
    fn what_is_no_answer_is_asked_for_again_and_an_empty_line_skips() {
        let (text, answers) = run("x\n7\n\n", None);
        assert_eq!(
            text.matches("expected a letter from a to c").count(),
            2,
            "{text}"
        );
        assert!(text.contains("Skipped."), "{text}");
        assert_eq!((answers.len(), answers[0].typed.as_str()), (1, ""));
    }

    #[test]
    fn the_letter_q_ends_the_questions() {
        let (text, answers) = run(&format!("q\n{}\n", letter(0)), None);
        assert!(answers.is_empty() && !text.contains("expected"), "{text}");
    }

    #[test]
    fn wrong_numbers_are_matched_with_mistakes() {
        for key in ["part1.task3", "part2.task2"] {
            let example = worked_examples::of(key, 5).expect("an example");
            let right: String = example
                .asked
                .iter()
                .map(|asked| format!("{:.4}\n", asked.truth))
                .collect();
            let (text, answers) = run(&format!("\n{right}"), Some(&example));
            assert_eq!(
                text.matches("Right.").count(),
                example.asked.len(),
                "{text}"
            );
            assert_eq!(
                answers.iter().filter(|answer| answer.is_right).count(),
                example.asked.len()
            );
            let (value, what) = example.asked[0].mistakes[0];
            let (text, answers) = run(&format!("\nno\n{value}\n"), Some(&example));
            assert!(
                text.contains("expected a number such as 0.25 or 1/4"),
                "{text}"
            );
            assert!(
                text.contains(&format!("No: that is {what}. It is")),
                "{text}"
            );
            assert_eq!(answers.len(), 2, "the input ended after the first number");
        }
    }
}
