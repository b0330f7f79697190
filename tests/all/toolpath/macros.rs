//! Macros are run: expressions against LinuxCNC's own interpreter, and unknown values stay unknown. Whole macros are in `tests/programs`.

use proptest::prelude::*;

use super::*;

/// Expressions of known numbers, compared with the interpreter.
fn expression() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        (-200i32..200).prop_map(|n| format!("{}", f64::from(n) / 8.0)),
        Just("#20".to_owned()),
        Just("#<b>".to_owned()),
        Just("-#20".to_owned()),
    ];
    leaf.prop_recursive(4, 24, 3, |inner| {
        prop_oneof![
            (
                inner.clone(),
                prop_oneof![Just("+"), Just("-"), Just("*")],
                inner.clone()
            )
                .prop_map(|(a, operator, b)| format!("[{a} {operator} {b}]")),
            (inner.clone(), inner.clone(), inner.clone())
                .prop_map(|(a, b, c)| format!("[{a} - {b} * {c} + 1]")),
            (
                inner.clone(),
                prop_oneof![
                    Just("ABS"),
                    Just("SIN"),
                    Just("COS"),
                    Just("FIX"),
                    Just("FUP"),
                    Just("ROUND")
                ]
            )
                .prop_map(|(a, name)| format!("{name}[{a}]")),
            inner.clone().prop_map(|a| format!("SQRT[ABS[{a}]]")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("ATAN[{a}]/[ABS[{b}] + 1]")),
            (
                inner.clone(),
                prop_oneof![Just("GT"), Just("LE"), Just("NE")],
                inner
            )
                .prop_map(|(a, operator, b)| format!("[[{a} * 3] {operator} [{b} + 0.4]]")),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]
    #[test]
    fn expressions_come_to_what_the_interpreter_computes(all in prop::collection::vec(expression(), 12)) {
        let lines: String = all.iter().map(|text| format!("G1 X[{text} / 1000]\n")).collect();
        let text = format!("G21 G90\n#20 = 3.25\n#<b> = -7.5\nG0 X0 Y0 Z0\nF100\n{lines}M2\n");
        // A value beyond the interpreter's print is compared to its sixth digit.
        let ran = interpret(&text);
        prop_assume!(ran.is_ok());
        let ran = ran.unwrap();
        let path = read_program(&text, None);
        prop_assert_eq!(path.len(), ran.moves.len(), "{}", text);
        for (i, (own, other)) in places(&path).iter().zip(&ran.moves).enumerate() {
            let line = text.lines().nth(path.line[i] as usize);
            prop_assert!((own[0] - other.to[0]).abs() <= 1e-3 + 1e-6 * other.to[0].abs(), "{:?}: {} truly {}", line, own[0], other.to[0]);
        }
    }
}

/// Values that only the control knows are not guessed, and conditions on them make later values unknown.
#[test]
fn what_is_not_known_stays_unknown() {
    // A possible jump back may repeat lines; a block that may be skipped makes its variables unknown.
    for body in [
        // A branch that jumps over the other one.
        "IF[#5061 GT 3.]GOTO 10\n#101=1.\nGOTO 20\nN10 #101=2.\nN20 G4 P1.\n",
        // Blocks with the same number in another program are no targets.
        "#101=1.\nIF[#5061 GT 3.]GOTO 20\nG65 P9300\n#101=2.\nN20 G4 P1.\n",
        // A variable that another round may set in a branch that this one skips.
        "#101=1.\n#102=0.\nWHILE[#5061 GT 3.]DO1\nIF[#102 EQ 1.]THEN #101=5.\n#102=1.\nEND1\n",
        "#101=1.\nM463\n",
        "#101=1.\nG65 P9810 X2.\n",
        "#101=1.\n/G65 P9300\n",
        "#101=ROUND[1.4]\n#101=-#0\n",
        "#102=1.\nIF[#102 EQ 1. AND #102 EQ 1.]THEN #101=3.\n",
        "#101=1.\nG65 P9811 X5.\n",
        "#101=1.\nM98 P77\n",
        "#101=1.\nN10 #101=#101+1.\nIF[#5061 GT 3.]GOTO 10\n",
        "#101=1.\n/#101=2.\n",
        "#101=1.\n/GOTO 20\n#101=2.\n",
        "#101=1. #102=#101\n",
        "#101=1.\nGOTO #5061\n#101=2.\n",
        "#101=1.\nWHILE[#5061 GT 3.]DO1\n#101=#101+1.\nEND1\n",
        "#101=1.\nIF[#5061 GT 3.]THEN #101=2.\n",
    ] {
        let ends = places(&read_program(
            &format!(
                "O1\nG21 G90\nG0 X0. Y0. Z0.\n{body}G0 Y1.\nG1 X#101 F100.\nM30\nO9300\nN20 #103=1.\nM99\n"
            ),
            None,
        ));
        assert!(ends.last().unwrap()[0].is_nan(), "{body}{ends:?}");
    }
    for body in [
        "#<a> = 1\no<m> sub\n#[#5063] = 2\n#<r> = #7\no<m> endsub [#7]\no<m> call\n#1 = #<_value>\n",
        "#1 = 1\n#1 = WHAT[3]\n",
        "#1 = 1\n#100 = 5\no<not_here> call\n#1 = #100\n",
        "#1 = 1\no1 do\n#1 = [#1 + 1]\no1 while [#5070 EQ 0]\n",
        "#1 = 1\no1 while [#1 LT 5]\no2 if [#5070 EQ 0]\no1 break\no2 endif\n#1 = [#1 + 1]\no1 endwhile\n",
        "o<s> sub\no1 if [#5070 EQ 0]\no<s> return\no1 endif\n#100 = 2\no<s> endsub\n#100 = 1\no<s> call\n#1 = #100\n",
        "#1 = 1\no1 repeat [#5063]\n#1 = 2\no1 endrepeat\n",
        "#1 = 1\no1 if [#5063]\n#1 = 2\no1 elseif [1]\n#1 = 3\no1 else\n#1 = 4\no1 endif\n",
        "#1 = 1\no1 if [0]\n#1 = 2\no1 elseif [#5063]\n#1 = 3\no1 else\n#1 = 4\no1 endif\n",
    ] {
        let path = read_program(
            &format!("G21 G90\nG0 X0 Y0 Z0\n{body}G1 X#1 F100\nG1 Y1\nM2\n"),
            None,
        );
        assert!(places(&path)[1][0].is_nan(), "{body}{:?}", places(&path));
    }
}

/// Reading ends for any text, even with an endless loop.
#[test]
fn hostile_macros_come_back() {
    for text in [
        "o1 while [1]\no1 endwhile\n",
        "N10 #1=1\nGOTO 10\n",
        "o<a> sub\no<a> call\no<a> endsub\no<a> call\n",
        "O1\nG65 P1\nM99\n",
        "o1 repeat [1e9]\n#1=[#1+1]\no1 endrepeat\n",
        "#1=[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]\n",
        "#################################################1=1\nX#\nX#<\nX#[\no<\no< > if\no1 if\nIF[\nIF[1]GOTO\nWHILE[1]DO\nEND\n",
        "o1 if [1]\no1 if [1]\no1 else\no1 else\no1 endif\no1 endif\no1 endif\n",
        "G65\nG65P\nG65P1A\nG65 P1 L1e9\nO1\n",
        &"o1 while [0]\n".repeat(60_000),
        &"o1 if [0]\no1 endif\n".repeat(40_000),
        &format!(
            "{}#1=0\nN7 #1=[#1+1]\nIF[#1 LT 90000]GOTO 7\n",
            "N8 X1\n".repeat(40_000)
        ),
        &"o<a> call\n".repeat(60_000),
        &("IF [1] THEN ".repeat(12_800) + "#1=2\n"),
        &("if[1]then".repeat(12_800) + "goto 5\n"),
        &(0..30_000)
            .map(|n| format!("o<{n}> sub\no<{n}> endsub\no<{n}> call\n"))
            .collect::<String>(),
        "X[1/0]\nX[SQRT[-1]]\nX[LN[0]]\nX[5 MOD 0]\nX[1**1e9]\nXEXISTS[#<a>]\n",
    ] {
        let path = read_program(text, Some("iso"));
        assert!(
            path.to.iter().all(|x| x.is_nan() || x.is_finite()),
            "{text}"
        );
    }
}
