//! Languages of controls as rows: operators, brackets, functions and words.

/// A family of languages with the same names and meanings of variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// LinuxCNC and compatible controls: O words, `#<name>`.
    LinuxCnc,
    /// Macro B of Fanuc and compatible controls.
    MacroB,
    /// Macros of an LNC: `#` and `@`, nested structures.
    Lnc,
    /// Eding CNC: `#`, nested structures, SUB and GOSUB.
    Eding,
    /// RepRapFirmware: names, `{ }`, structures by indentation.
    RepRap,
    Sinumerik,
    /// HEIDENHAIN: Q parameters, in Klartext and in ISO.
    Heidenhain,
}

impl Language {
    /// Whether variables have numbers: `#5`.
    pub fn is_macro(self) -> bool {
        matches!(
            self,
            Language::LinuxCnc | Language::MacroB | Language::Lnc | Language::Eding
        )
    }
}

/// A binary operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    Or,
    Xor,
    And,
    Equal,
    Unequal,
    Greater,
    GreaterOrEqual,
    Less,
    LessOrEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    DivideWhole,
    Modulo,
    Power,
    /// Hypotenuse of two sides: `a LEN b`.
    Length,
    /// Angle of two sides, 0 to 360: `opposite ANG adjacent`.
    Angle,
}

/// A function of one or two values; angles are in degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    Absolute,
    Sine,
    Cosine,
    Tangent,
    ArcSine,
    ArcCosine,
    /// Arc tangent of a slope, or of `[y]/[x]`.
    ArcTangent,
    ArcTangent2,
    SquareRoot,
    Square,
    Negative,
    Sign,
    Truncate,
    Fraction,
    Round,
    /// Next lower whole number; on a Fanuc towards 0.
    Fix,
    /// Next higher whole number; on a Fanuc away from 0.
    Up,
    Least,
    Greatest,
    Floor,
    Ceiling,
    Power,
    Modulo,
    /// Whether a variable was set.
    Exists,
    NotExists,
    /// Negation of a condition.
    Not,
    /// A function that no known probing program needs.
    NotComputed,
}

/// Notation of values in a language.
#[derive(Debug)]
pub struct Grammar {
    pub language: Language,
    /// Binary operators, the loosest row first; in a row the longer ones first.
    pub operators: &'static [&'static [(&'static str, Operator)]],
    /// Brackets around a part of an expression.
    pub brackets: (u8, u8),
    /// Longer names first.
    pub functions: &'static [(&'static str, Function)],
    /// Values by name.
    pub constants: &'static [(&'static str, f64)],
    /// Whether an operator of letters ends before the next letter of a name.
    pub is_spaced: bool,
    /// Whether a function needs no brackets: `SIN +30`.
    pub is_prefix: bool,
    /// Deepest nesting of subprograms.
    pub deepest: usize,
    /// Words of nested structures.
    pub words: &'static [(&'static str, Keyword)],
    /// Whether structures end by indentation.
    pub is_indented: bool,
    /// Words that stop the program with a message.
    pub alarms: &'static [&'static str],
    /// Words that neither move nor set anything.
    pub ignored: &'static [&'static str],
    /// First number of the variables of the last contact.
    pub contact: i32,
    /// Codes of probing moves, with the word of a G31 for the same meaning of a contact.
    pub probing: &'static [(&'static str, &'static str)],
    /// Start of a comment beside `;`, and the brackets around it.
    pub comment: Option<&'static str>,
}

const MACRO_OPERATORS: &[&[(&str, Operator)]] = &[
    &[
        ("AND", Operator::And),
        ("XOR", Operator::Xor),
        ("OR", Operator::Or),
    ],
    &[
        ("EQ", Operator::Equal),
        ("NE", Operator::Unequal),
        ("GE", Operator::GreaterOrEqual),
        ("GT", Operator::Greater),
        ("LE", Operator::LessOrEqual),
        ("LT", Operator::Less),
    ],
    &[("+", Operator::Add), ("-", Operator::Subtract)],
    &[
        ("*", Operator::Multiply),
        ("/", Operator::Divide),
        ("MOD", Operator::Modulo),
    ],
    &[("**", Operator::Power)],
];

const MACRO_FUNCTIONS: &[(&str, Function)] = &[
    ("ABS", Function::Absolute),
    ("SIN", Function::Sine),
    ("COS", Function::Cosine),
    ("TAN", Function::Tangent),
    ("ASIN", Function::ArcSine),
    ("ACOS", Function::ArcCosine),
    ("ATAN", Function::ArcTangent),
    ("SQRT", Function::SquareRoot),
    ("SQR", Function::SquareRoot),
    ("ROUND", Function::Round),
    ("RND", Function::Round),
    ("FIX", Function::Fix),
    ("FUP", Function::Up),
    ("EXP", Function::NotComputed),
    ("LN", Function::NotComputed),
];

/// Functions of macros plus these, `N` in all.
const fn macro_functions<const N: usize>(
    more: &[(&'static str, Function)],
) -> [(&'static str, Function); N] {
    assert!(N == MACRO_FUNCTIONS.len() + more.len());
    let mut all = [("", Function::NotComputed); N];
    let mut i = 0;
    while i < N {
        all[i] = if i < MACRO_FUNCTIONS.len() {
            MACRO_FUNCTIONS[i]
        } else {
            more[i - MACRO_FUNCTIONS.len()]
        };
        i += 1;
    }
    all
}

/// LinuxCNC's words, by its documentation.
pub const LINUXCNC: Grammar = Grammar {
    language: Language::LinuxCnc,
    operators: MACRO_OPERATORS,
    brackets: (b'[', b']'),
    functions: &macro_functions::<16>(&[("EXISTS", Function::Exists)]),
    constants: &[],
    is_spaced: false,
    is_prefix: false,
    deepest: 10,
    words: &[],
    is_indented: false,
    alarms: &[],
    ignored: &[],
    contact: 5061,
    probing: &[],
    comment: None,
};

/// PlanetCNC, by public macros.
pub const PLANETCNC: Grammar = Grammar {
    functions: &macro_functions::<19>(&[
        ("EXISTS", Function::Exists),
        ("NOTEXISTS", Function::NotExists),
        ("LNOT", Function::Not),
        ("ACTIVE", Function::NotComputed),
    ]),
    ..LINUXCNC
};

/// Mach3: its contact is in #2000 to #2002 [R].
pub const MACH3: Grammar = Grammar {
    contact: 2000,
    ..MACRO_B
};

/// Macro B of Fanuc and compatible controls.
pub const MACRO_B: Grammar = Grammar {
    language: Language::MacroB,
    functions: MACRO_FUNCTIONS,
    ..LINUXCNC
};

/// Centroid, by its help: M115 and M116 report an error without a contact, M125 and M126 with one.
pub const CENTROID: Grammar = Grammar {
    probing: &[
        ("M115", "M79"),
        ("M116", "M79"),
        ("M125", "M78"),
        ("M126", "M78"),
    ],
    ..MACRO_B
};

/// SINUMERIK, by its programming manual.
pub const SINUMERIK: Grammar = Grammar {
    language: Language::Sinumerik,
    operators: &[
        &[("OR", Operator::Or), ("XOR", Operator::Xor)],
        &[("AND", Operator::And)],
        &[
            ("==", Operator::Equal),
            ("<>", Operator::Unequal),
            (">=", Operator::GreaterOrEqual),
            ("<=", Operator::LessOrEqual),
            (">", Operator::Greater),
            ("<", Operator::Less),
        ],
        &[("+", Operator::Add), ("-", Operator::Subtract)],
        &[
            ("*", Operator::Multiply),
            ("/", Operator::Divide),
            ("DIV", Operator::DivideWhole),
            ("MOD", Operator::Modulo),
        ],
    ],
    brackets: (b'(', b')'),
    functions: &[
        ("ABS", Function::Absolute),
        ("SIN", Function::Sine),
        ("COS", Function::Cosine),
        ("TAN", Function::Tangent),
        ("ASIN", Function::ArcSine),
        ("ACOS", Function::ArcCosine),
        ("ATAN2", Function::ArcTangent2),
        ("SQRT", Function::SquareRoot),
        ("POT", Function::Square),
        ("TRUNC", Function::Truncate),
        ("ROUND", Function::Round),
        ("MINVAL", Function::Least),
        ("MAXVAL", Function::Greatest),
    ],
    constants: &[("TRUE", 1.0), ("FALSE", 0.0)],
    is_spaced: true,
    words: &[
        ("IF", Keyword::If),
        ("ELSE", Keyword::Else),
        ("ENDIF", Keyword::EndIf),
        ("WHILE", Keyword::While),
        ("ENDWHILE", Keyword::EndWhile),
        ("FOR", Keyword::For),
        ("ENDFOR", Keyword::EndFor),
        ("LOOP", Keyword::Loop),
        ("ENDLOOP", Keyword::EndLoop),
        ("REPEAT", Keyword::Do),
        ("UNTIL", Keyword::Until),
    ],
    alarms: &["SETAL"],
    ignored: &["STOPRE", "MSG", "PROC", "EXTERN"],
    ..LINUXCNC
};

/// Operators of macro B, and signs for them.
const SIGNED_OPERATORS: &[&[(&str, Operator)]] = &[
    &[
        ("AND", Operator::And),
        ("XOR", Operator::Xor),
        ("OR", Operator::Or),
        ("&&", Operator::And),
        ("||", Operator::Or),
    ],
    &[
        ("EQ", Operator::Equal),
        ("NE", Operator::Unequal),
        ("GE", Operator::GreaterOrEqual),
        ("GT", Operator::Greater),
        ("LE", Operator::LessOrEqual),
        ("LT", Operator::Less),
        ("==", Operator::Equal),
        ("!=", Operator::Unequal),
        ("<>", Operator::Unequal),
        (">=", Operator::GreaterOrEqual),
        ("<=", Operator::LessOrEqual),
        (">", Operator::Greater),
        ("<", Operator::Less),
    ],
    &[("+", Operator::Add), ("-", Operator::Subtract)],
    &[
        ("*", Operator::Multiply),
        ("/", Operator::Divide),
        ("MOD", Operator::Modulo),
    ],
    &[("**", Operator::Power)],
];

/// LNC, by its macro manual and a maker's public macro set.
pub const LNC: Grammar = Grammar {
    language: Language::Lnc,
    operators: SIGNED_OPERATORS,
    functions: MACRO_FUNCTIONS,
    words: &[
        ("IF", Keyword::If),
        ("ELSEIF", Keyword::ElseIf),
        ("ELSE", Keyword::Else),
        ("END_IF", Keyword::EndIf),
        ("WHILE", Keyword::While),
        ("END_WHILE", Keyword::EndWhile),
        ("FOR", Keyword::For),
        ("END_FOR", Keyword::EndFor),
        ("EXIT_FOR", Keyword::Break),
    ],
    alarms: &["ALARM"],
    ignored: &[
        "FIX_CUT_OR_ON",
        "FIX_CUT_OR_OFF",
        "MENU_ADD",
        "MENU",
        "MSG_OK",
        // Unlocks the spindle's orientation.
        "M20",
    ],
    comment: Some("//"),
    ..LINUXCNC
};

/// Eding CNC, by its manual and public macro sets.
pub const EDING: Grammar = Grammar {
    language: Language::Eding,
    operators: SIGNED_OPERATORS,
    functions: MACRO_FUNCTIONS,
    words: &[
        ("SUB", Keyword::Sub),
        ("ENDSUB", Keyword::EndSub),
        ("GOSUB", Keyword::Call),
        ("IF", Keyword::If),
        ("ELSEIF", Keyword::ElseIf),
        ("ELSE", Keyword::Else),
        ("ENDIF", Keyword::EndIf),
        ("WHILE", Keyword::While),
        ("ENDWHILE", Keyword::EndWhile),
    ],
    alarms: &["ERRMSG"],
    ignored: &["MSG", "WARNMSG", "DLGMSG", "LOGMSG"],
    ..LINUXCNC
};

/// RepRapFirmware, by its documentation of meta commands. Its angles are in radians: functions of them are not computed.
pub const REPRAP: Grammar = Grammar {
    language: Language::RepRap,
    operators: &[
        &[("||", Operator::Or), ("|", Operator::Or)],
        &[("&&", Operator::And), ("&", Operator::And)],
        &[
            ("==", Operator::Equal),
            ("!=", Operator::Unequal),
            (">=", Operator::GreaterOrEqual),
            ("<=", Operator::LessOrEqual),
            ("=", Operator::Equal),
            (">", Operator::Greater),
            ("<", Operator::Less),
        ],
        &[("+", Operator::Add), ("-", Operator::Subtract)],
        &[("*", Operator::Multiply), ("/", Operator::Divide)],
    ],
    brackets: (b'(', b')'),
    functions: &[
        ("exists", Function::Exists),
        ("abs", Function::Absolute),
        ("sqrt", Function::SquareRoot),
        ("pow", Function::Power),
        ("floor", Function::Floor),
        ("ceil", Function::Ceiling),
        ("min", Function::Least),
        ("max", Function::Greatest),
        ("mod", Function::Modulo),
    ],
    constants: &[("true", 1.0), ("false", 0.0)],
    is_spaced: true,
    words: &[
        ("if", Keyword::If),
        ("elif", Keyword::ElseIf),
        ("else", Keyword::Else),
        ("while", Keyword::While),
        ("break", Keyword::Break),
        ("continue", Keyword::Continue),
    ],
    is_indented: true,
    alarms: &["abort"],
    ignored: &["echo"],
    ..LINUXCNC
};

/// HEIDENHAIN's formulas and FN functions, by its manual.
pub const HEIDENHAIN: Grammar = Grammar {
    language: Language::Heidenhain,
    operators: &[
        &[
            ("EQU", Operator::Equal),
            ("NE", Operator::Unequal),
            ("GT", Operator::Greater),
            ("LT", Operator::Less),
        ],
        &[("+", Operator::Add), ("-", Operator::Subtract)],
        &[
            ("*", Operator::Multiply),
            ("/", Operator::Divide),
            ("DIV", Operator::Divide),
            ("LEN", Operator::Length),
            ("ANG", Operator::Angle),
        ],
        &[("^", Operator::Power)],
    ],
    brackets: (b'(', b')'),
    functions: &[
        ("SQRT", Function::SquareRoot),
        ("SQ", Function::Square),
        ("SIN", Function::Sine),
        ("COS", Function::Cosine),
        ("TAN", Function::Tangent),
        ("ASIN", Function::ArcSine),
        ("ACOS", Function::ArcCosine),
        ("ATAN", Function::ArcTangent),
        ("LN", Function::NotComputed),
        ("LOG", Function::NotComputed),
        ("EXP", Function::NotComputed),
        ("NEG", Function::Negative),
        ("INT", Function::Truncate),
        ("FRAC", Function::Fraction),
        ("ABS", Function::Absolute),
        ("SGN", Function::Sign),
    ],
    constants: &[("PI", std::f64::consts::PI)],
    is_prefix: true,
    deepest: 20,
    ..LINUXCNC
};

/// A word that begins, continues or ends a structure of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keyword {
    Sub,
    EndSub,
    Return,
    Call,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    /// A loop with its condition at the end: `do … while` of LinuxCNC, `REPEAT … UNTIL` of a SINUMERIK.
    Do,
    Until,
    /// A number of times.
    Repeat,
    EndRepeat,
    For,
    EndFor,
    /// A loop without a condition.
    Loop,
    EndLoop,
    Break,
    Continue,
}

impl Keyword {
    /// The word that ends the structure begun by this word; `None` if it begins none.
    pub fn end(self) -> Option<Keyword> {
        Some(match self {
            Keyword::If => Keyword::EndIf,
            Keyword::While => Keyword::EndWhile,
            Keyword::Do => Keyword::Until,
            Keyword::Repeat => Keyword::EndRepeat,
            Keyword::For => Keyword::EndFor,
            Keyword::Loop => Keyword::EndLoop,
            _ => return None,
        })
    }

    /// Whether the program may continue elsewhere because of it, outside of a structure.
    pub fn jumps(self) -> bool {
        matches!(
            self,
            Keyword::Call | Keyword::Return | Keyword::Break | Keyword::Continue
        )
    }
}

/// Words after the label of an O word.
pub const O_WORDS: [(&str, Keyword); 15] = [
    ("sub", Keyword::Sub),
    ("endsub", Keyword::EndSub),
    ("return", Keyword::Return),
    ("call", Keyword::Call),
    ("if", Keyword::If),
    ("elseif", Keyword::ElseIf),
    ("else", Keyword::Else),
    ("endif", Keyword::EndIf),
    ("while", Keyword::While),
    ("endwhile", Keyword::EndWhile),
    ("do", Keyword::Do),
    ("repeat", Keyword::Repeat),
    ("endrepeat", Keyword::EndRepeat),
    ("break", Keyword::Break),
    ("continue", Keyword::Continue),
];
