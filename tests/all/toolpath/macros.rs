//! Macros are run: O words against LinuxCNC's own interpreter, macro B against calculations by hand.

use proptest::prelude::*;

use super::*;

/// Every move of a program is the interpreter's: kind and end.
fn as_interpreted(text: &str) {
    let ran = interpret(text).unwrap_or_else(|why| panic!("{why}\n{text}"));
    let path = read_program(text, None);
    assert_eq!(path.len(), ran.moves.len(), "{text}\n{:?}\n{:?}", places(&path), path.findings);
    for (i, (own, other)) in places(&path).iter().zip(&ran.moves).enumerate() {
        // An axis that no block has named is at 0 there, and not known here.
        let same = (0..3).all(|axis| (own[axis] - other.to[axis]).abs() < 1e-3 || own[axis].is_nan() && other.to[axis] == 0.0);
        assert!(same, "{text}\nmove {i}, line {}: {own:?}, truly {:?}", path.line[i] + 1, other.to);
    }
    assert!(path.findings.iter().all(|finding| finding.code == "no-units"), "{text}\n{:?}", path.findings);
}

#[test]
fn o_words_run_as_the_interpreter_runs_them() {
    for text in [
        // Arguments, locals, a value given back, a call in a call.
        "G21 G90\no<deep> sub\nG38.3 Z#1 F#2\nG0 Z[#<_safe>]\no<deep> endsub [#1 * 2]\no<pair> sub\nG0 X#1 Y0\no<deep> call [#3] [60]\nG0 X#2\no<deep> call [#<_value>] [80]\no<pair> endsub\n#<_safe> = 7\nG0 X0 Y0 Z#<_safe>\no<pair> call [11] [22] [-1.5]\nM2\n",
        // A grid of two loops.
        "G21 G90\n#<rows> = 3\n#10 = 0\nG0 X0 Y0 Z5\no100 while [#10 LT #<rows>]\n#11 = 0\no101 while [#11 LT 2]\nG0 X[10 * #10] Y[5 + 20 * #11]\nG38.2 Z-4 F60\nG0 Z5\n#11 = [#11 + 1]\no101 endwhile\n#10 = [#10 + 1]\no100 endwhile\nM2\n",
        // Every branch, and one that is left early.
        "G21 G90\nG0 X0 Y0 Z0\n#1 = 0\no1 repeat [4]\no2 if [#1 EQ 0]\nG1 X1 F100\no2 elseif [#1 EQ 1]\nG1 X2\no2 elseif [#1 GE 2 AND #1 LT 3]\nG1 X3\no2 else\nG1 X4\no2 endif\n#1 = [#1 + 1]\no1 endrepeat\nM2\n",
        "G21 G90\nG0 X0 Y0 Z0\n#1 = 0\no1 while [1]\n#1 = [#1 + 1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\no3 if [#1 GT 4]\no1 break\no3 endif\nG1 X#1 F100\no1 endwhile\nG1 Y1\nM2\n",
        "G21 G90\nG0 X0 Y0 Z0\n#5 = 3\no1 do\nG1 X#5 F50\n#5 = [#5 - 1]\no1 while [#5 GT 0]\nG1 Y5\nM2\n",
        // A return in the middle, indirect variables, names with blanks and capitals.
        "G21 G90\nG0 X0 Y0 Z0\no<r> sub\no1 if [#1 LT 5]\no<r> return [1]\no1 endif\nG1 X9 F100\no<r> endsub [2]\n#40 = 41\n#41 = 7\nG1 X##40 F90\nG1 X#[#40 - 1 + 1]\n#<A Long Name> = 4\nG1 Y#<along_name> Z[#<alongname>]\no<r> call [3]\nG1 Y#<_value>\no<r> call [6]\nG1 Y#<_value>\nM2\n"
            .replace("#<along_name>", "#<alongname>")
            .as_str(),
        // Comparisons as they are, and equality within a ten-thousandth: ten tenths are less than 1.
        "G21 G90\nG0 X0 Y0 Z0\n#<t> = 0\no1 while [#<t> LT 1]\n#<t> = [#<t> + 0.1]\nG1 X#<t> F100\no1 endwhile\no2 if [1.00005 EQ 1]\nG1 Y1\no2 endif\no3 if [1.0002 NE 1]\nG1 Y2\no3 endif\no4 if [0.3 GE [0.1 + 0.2]]\nG1 Y3\no4 endif\nM2\n",
        // Out of a do, and a round of one that is left out.
        "G21 G90\nG0 X0 Y0 Z0\n#1 = 0\no1 do\n#1 = [#1 + 1]\no2 if [#1 EQ 3]\no1 break\no2 endif\nG1 X#1 F100\no1 while [#1 LT 9]\nG1 Y1\nM2\n",
        "G21 G90\nG0 X0 Y0 Z0\n#1 = 0\no1 do\n#1 = [#1 + 1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nG1 X#1 F100\no1 while [#1 LT 4]\nG1 Y1\nM2\n",
        // Numbered and named signs of existence in a call; arguments that are not given.
        "G21 G90\nG0 X0 Y0 Z0\no<e> sub\n#<here> = 1\no1 if [EXISTS[#<here>] AND EXISTS[#<there>]]\nG1 X1 F100\no1 else\nG1 X2 F100\no1 endif\nG1 Y[#2 + 4]\no<e> endsub\no<e> call [7]\nM2\n",
        // Assignments in one block take effect after it.
        "G21 G90\nG0 X0 Y0 Z0\n#<own>=3\n#1=1 #2=2\n#1=#2 #2=#1 G1 X#1 F100\nG1 X#1 Y#2\nM2\n",
        // Relative moves in a loop, and a subroutine below the end.
        "G21 G90\nG0 X1 Y1 Z1\no7 repeat [3]\nG91\nG1 X5 F100\nG90\no7 endrepeat\no<end> call\nG1 Y8\nM2\no<end> sub\nG1 Z3\no<end> endsub\n",
    ] {
        as_interpreted(text);
    }
}

/// Expressions of known numbers, as the interpreter computes them.
fn expression() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        (-200i32..200).prop_map(|n| format!("{}", f64::from(n) / 8.0)),
        Just("#20".to_owned()),
        Just("#<b>".to_owned()),
        Just("-#20".to_owned()),
    ];
    leaf.prop_recursive(4, 24, 3, |inner| {
        prop_oneof![
            (inner.clone(), prop_oneof![Just("+"), Just("-"), Just("*")], inner.clone())
                .prop_map(|(a, operator, b)| format!("[{a} {operator} {b}]")),
            (inner.clone(), inner.clone(), inner.clone()).prop_map(|(a, b, c)| format!("[{a} - {b} * {c} + 1]")),
            (inner.clone(), prop_oneof![Just("ABS"), Just("SIN"), Just("COS"), Just("FIX"), Just("FUP"), Just("ROUND")])
                .prop_map(|(a, name)| format!("{name}[{a}]")),
            inner.clone().prop_map(|a| format!("SQRT[ABS[{a}]]")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("ATAN[{a}]/[ABS[{b}] + 1]")),
            (inner.clone(), prop_oneof![Just("GT"), Just("LE"), Just("NE")], inner)
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
        // A value beyond what the interpreter prints is compared by its sixth digit.
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

/// By hand: 30/2 - 2 + 3.5 = 16.5; three rounds of a jump back; a THEN that holds and one that does not.
#[test]
fn macro_b_is_run() {
    let ends = |text: &str| {
        let path = read_program(text, None);
        assert!(path.findings.iter().all(|finding| finding.code == "no-units"), "{:?}", path.findings);
        places(&path)
    };
    let bore = "%\nO2201(BORE)\n#101=30.(DIAMETER)\n#102=2.\n#103=#101/2.-#102+3.5\nG21 G90 G17\nG0 X0 Y0 Z-5.\nG31 X#103 F150.\nG0 X0\nG31 X-#103 F150.\nG0 X0\nM30\n%\n";
    let [x, z] = [16.5, -5.0];
    assert_eq!(ends(bore), [[0.0, 0.0, z], [x, 0.0, z], [0.0, 0.0, z], [-x, 0.0, z], [0.0, 0.0, z]]);
    let jumps = "O1\nG90 G17\nG0 X0. Y0. Z0.\n#100=0.\nN10 IF[#100 GE 3.]GOTO 20\nG1 X[#100*10.] F100.\n#100=#100+1.\nGOTO 10\nN20 G1 Y5.\nM30\n";
    assert_eq!(ends(jumps)[1..], [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [20.0, 0.0, 0.0], [20.0, 5.0, 0.0]]);
    let then = "O2\nG90 G17\nG0 X0. Y0. Z0.\n#101=2.\nIF[#101 EQ 2.]THEN #102=7.5\nIF[#101 EQ 3.]THEN #102=9.\nG1 X#102 Y-[#102+1.] F100.\nM30\n";
    assert_eq!(ends(then)[1..], [[7.5, -8.5, 0.0]]);
}

/// By the definition of G65: A is #1, Z is #26, what is not given is nothing, and a word with nothing is left out.
#[test]
fn arguments_of_a_macro_are_its_variables() {
    let text = "O1\nG21 G90\nG0 X1. Y2. Z3.\n#1=50.\nG65 P9100 A5. Z-3.\nG1 X#1 F100.\nM30\nO9100\nG1 X[#1*2.] Y#25 Z#26 F60.\nIF[#7 EQ #0]THEN #7=4.\nG1 Y#7\nM99\n";
    let path = read_program(text, None);
    assert_eq!(places(&path), [[1.0, 2.0, 3.0], [10.0, 2.0, -3.0], [10.0, 4.0, -3.0], [50.0, 4.0, -3.0]]);
    assert!(path.findings.is_empty(), "{:?}", path.findings);
    let loops = "O1\nG21 G90\nG0 X0. Y0. Z0.\n#101=1.\nWHILE[#101 LE 2.]DO1\n#102=1.\nWHILE[#102 LE 2.]DO2\nG1 X#101 Y#102 F9.\n#102=#102+1.\nEND2\n#101=#101+1.\nEND1\nG1 Z1.\nM30\n";
    let ends: Vec<[f64; 3]> = places(&read_program(loops, None));
    assert_eq!(ends[1..], [[1.0, 1.0, 0.0], [1.0, 2.0, 0.0], [2.0, 1.0, 0.0], [2.0, 2.0, 0.0], [2.0, 2.0, 1.0]]);
}

/// A loop that was left by a jump is over; a THEN may jump; a return below a call that is not sure is one.
#[test]
fn jumps_leave_what_they_leave() {
    let loops = "O1\nG21 G90\nG0 X0. Y0. Z0.\n#101=0.\nWHILE[#101 LT 5.]DO1\n#101=#101+1.\nIF[#101 EQ 2.]THEN GOTO 50\nG1 X#101 F9.\nEND1\nN50 #101=10.\nWHILE[#101 LT 12.]DO1\nG1 Y#101\n#101=#101+1.\nEND1\nG1 Z1.\nM30\n";
    let ends = places(&read_program(loops, None));
    assert_eq!(ends[1..], [[1.0, 0.0, 0.0], [1.0, 10.0, 0.0], [1.0, 11.0, 0.0], [1.0, 11.0, 1.0]]);
    let guarded = "G21 G90\nG0 X0 Y0 Z0\no<s> sub\nG1 X5 F100\no<s> return\nG1 X9\no<s> endsub\no1 if [#5070 EQ 0]\no<s> call\no1 endif\nG1 Y1\nM2\n";
    assert_eq!(places(&read_program(guarded, None))[1..], [[5.0, 0.0, 0.0], [5.0, 1.0, 0.0]]);
}

/// A return to a block of the caller; a macro that ends at the next program; an `elseif` that is not known below one that is.
#[test]
fn ways_back_and_branches_below() {
    let block = "O1\nG21 G90\nG0 X0. Y0. Z0.\nG65 P9300 A4.\nG1 X9. F9.\nN30 G1 Y1. F9.\nM30\nO9300\nG1 X#1 F9.\nM99 P30\n";
    assert_eq!(places(&read_program(block, None))[1..], [[4.0, 0.0, 0.0], [4.0, 1.0, 0.0]]);
    let open = "O1\nG21 G90\nG0 X0. Y0. Z0.\nG65 P9300\nG1 Y1. F9.\nM30\nO9300\nG1 X4. F9.\nO9400\nG1 Z9. F9.\nM99\n";
    assert_eq!(places(&read_program(open, None))[1..], [[4.0, 0.0, 0.0], [4.0, 1.0, 0.0]]);
    let nested = "G21 G90\nG0 X0 Y0 Z0\no1 if [#5070 EQ 0]\no2 if [0]\no2 elseif [#5070 EQ 0]\nG1 X1 F9\no2 endif\nM2\no1 endif\nG1 Y1 F9\nM2\n";
    assert_eq!(
        places(&read_program(nested, None)).last().unwrap()[1],
        1.0,
        "an end in a branch that is not known ends nothing"
    );
    // Each subroutine begins where nobody knows; one that is called by another is not shown by itself.
    let library = "o<a> sub\nG90 G1 X1 F9\no<b> call [2]\no<a> endsub\no<b> sub\nG1 Y#1 F9\no<b> endsub\no<c> sub\nG91 G1 Z1 F9\nG90\no<c> endsub\n";
    let path = read_program(library, None);
    let names = |finding: &&crate::form::Finding| finding.code == "not-called";
    assert_eq!((path.len(), path.findings.iter().filter(names).count()), (3, 2));
    assert!(path.end(1).y == 2.0 && path.end(2).x.is_nan() && path.end(2).y.is_nan(), "{:?}", places(&path));
}

/// What the control would know is not guessed, and what it guards is not sure from there on.
#[test]
fn what_is_not_known_stays_unknown() {
    let path = read_program(
        "G21 G90\nG0 X0 Y0 Z0\n#1 = 5\no1 if [#5070 EQ 0]\n#1 = 6\no1 endif\nG1 X#1 F100\n#1 = 8\nG1 X#1\nM2\n",
        None,
    );
    assert!(places(&path)[1][0].is_nan(), "it may be 5 or 6");
    assert_eq!(places(&path)[2], [8.0, 0.0, 0.0]);
    assert_eq!(said(&path), ["lines-skipped", "places-computed"]);
    // A jump that may be made, up to its block.
    let jump =
        "O1\nG21 G90\nG0 X0. Y0. Z0.\n#101=5.\nIF[#5061 GT 3.]GOTO 10\n#101=6.\nN10 G1 X#101 F100.\n#101=8.\nG1 X#101\nM30\n";
    let ends = places(&read_program(jump, None));
    assert!(ends[1][0].is_nan() && ends[2][0] == 8.0, "{ends:?}");
    // A jump back that may be made repeats what it repeats; a block that may be left out sets nothing for sure.
    for body in [
        // A branch that jumps over the other one.
        "IF[#5061 GT 3.]GOTO 10\n#101=1.\nGOTO 20\nN10 #101=2.\nN20 G4 P1.\n",
        // Blocks of the same number in another program are no targets.
        "#101=1.\nIF[#5061 GT 3.]GOTO 20\nG65 P9300\n#101=2.\nN20 G4 P1.\n",
        // What another round may set in a branch that this one does not run.
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
            &format!("O1\nG21 G90\nG0 X0. Y0. Z0.\n{body}G0 Y1.\nG1 X#101 F100.\nM30\nO9300\nN20 #103=1.\nM99\n"),
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
        let path = read_program(&format!("G21 G90\nG0 X0 Y0 Z0\n{body}G1 X#1 F100\nG1 Y1\nM2\n"), None);
        assert!(places(&path)[1][0].is_nan(), "{body}{:?}", places(&path));
    }
    // A word rounds to the smallest step of its axis on a Fanuc, whichever that is.
    let rounds = places(&read_program(
        "O1\nG21 G90\nG0 X0. Y0. Z0.\n#101=ROUND[1.4]\nG1 X#101 F9.\nG1 Y[ROUND[1.4]]\nG31 Z-1.\nM30\n",
        None,
    ));
    assert!(rounds[1][0] == 1.0 && rounds[2][1].is_nan(), "{rounds:?}");
    // What the program sets again is known again.
    let again = "G21 G90\nG0 X0 Y0 Z0\n#1 = 1\no1 do\n#1 = [#1 + 1]\no1 while [#5070 EQ 0]\n#1 = 8\nG1 X#1 F100\nM2\n";
    assert_eq!(places(&read_program(again, None))[1][0], 8.0);
    // An indirect write may be to any variable.
    let any = read_program("G21 G90\nG0 X0 Y0 Z0\n#31 = 5\n#[#5063] = 1\nG1 X#31 F100\nM2\n", None);
    assert!(places(&any)[1][0].is_nan());
}

#[test]
fn a_text_of_subroutines_is_shown_and_said() {
    let path =
        read_program("o<right_edge> sub\nG21 G90\nG0 X5 Y0 Z5\nG38.2 X#1 F80\nG0 Y[2 + 1]\no<right_edge> endsub\nM2\n", None);
    assert_eq!((path.len(), kinds(&path)[1]), (3, "probe"));
    assert!(path.end(1).x.is_nan(), "its argument is not known");
    let own = path.findings.iter().find(|finding| finding.code == "not-called").expect("said");
    assert!(own.message.contains("<right_edge>"), "{}", own.message);
}

#[test]
fn calls_of_the_controls_own_macros_are_named() {
    let text = "G21 G90 G17\nT20 M6\nG54 G0 X14.5 Y-30.\nG43 H20 Z25.\nG65 P9810 Z-8. F2500.\nG65 P9811 Y-21. S1.\nG65 P9810 Z25.\nM30\n";
    let path = read_program(text, None);
    let on = |line: u32| path.line.iter().position(|own| *own == line).map(|i| places(&path)[i]);
    assert_eq!(on(4), Some([14.5, -30.0, -8.0]), "9810 goes where it says");
    assert_eq!(on(5), None);
    assert!(on(6).is_some_and(|end| end[0].is_nan() && end[2] == 25.0), "where 9811 ends is not known");
    assert!(path.findings.iter().any(|finding| finding.message.contains("P9811")), "{:?}", path.findings);
    let cycle = read_program("G71 G90\nG0 X1 Y2 Z3\nCYCLE978(0,,,1,60,12)\nG0 Z40\nM30\n", Some("sinumerik"));
    assert!(cycle.findings.iter().any(|finding| finding.message.contains("CYCLE978")), "{:?}", cycle.findings);
}

/// Whatever stands there: it comes back, and a loop without an end has one.
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
        &format!("{}#1=0\nN7 #1=[#1+1]\nIF[#1 LT 90000]GOTO 7\n", "N8 X1\n".repeat(40_000)),
        &"o<a> call\n".repeat(60_000),
        &(0..30_000).map(|n| format!("o<{n}> sub\no<{n}> endsub\no<{n}> call\n")).collect::<String>(),
        "X[1/0]\nX[SQRT[-1]]\nX[LN[0]]\nX[5 MOD 0]\nX[1**1e9]\nXEXISTS[#<a>]\n",
    ] {
        let path = read_program(text, Some("iso"));
        assert!(path.to.iter().all(|x| x.is_nan() || x.is_finite()), "{text}");
    }
}
