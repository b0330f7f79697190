//! Common part of word-address dialects: the writer of blocks and the printer of expressions; the lexer and the parser that read a program back, and the
//! machine that runs it.
//!
//! Writing and reading share no code, only the data of a dialect: the proof could not see an error in shared code.

pub mod block;
pub mod codes;
pub mod lex;
pub mod line_cache;
pub mod lines;
pub mod machine;
pub mod parse;
pub mod print;
pub mod registers;
pub mod script;
pub mod targets;
pub mod words;
pub mod writer;
