//! What word-address dialects share: the writer of blocks and the printer of expressions; the lexer and the parser that read a program back,
//! and the machine that follows it.
//!
//! Writing and reading share no code, only the dialect's data: what both would get wrong together, the proof would not see.

pub mod codes;
pub mod lex;
pub mod lines;
pub mod machine;
pub mod memory;
pub mod parse;
pub mod print;
pub mod registers;
pub mod script;
pub mod targets;
pub mod words;
pub mod writer;
