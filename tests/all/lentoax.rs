//! LENTOAX: the printed examples, the table of values, and properties of every frame.

use proptest::prelude::*;
use touchpath::form::Value;
use touchpath::geom::Plane;
use touchpath::job::lentoax_query;
use touchpath::tool_length::{Answer, Axis, Query, Step, lentoax, nc_block, sentence};

fn mill() -> Query {
    Query {
        plane: Plane::G17,
        tool_type: 120,
        frame: Vec::new(),
        coord: "WCS".into(),
        tool_active: true,
        sd42900: false,
        sd42940: 0,
        sd42950: 0,
    }
}

fn rot(axis: char, angle: f64) -> Step {
    Step::Rotation {
        axis: Axis::ALL["XYZ".find(axis).unwrap()],
        angle,
    }
}

fn asked(change: impl Fn(&mut Query)) -> (i32, [i32; 3]) {
    let mut query = mill();
    change(&mut query);
    let Answer { status, axind, .. } = lentoax(&query);
    (status, axind)
}

/// The manual's standard case, and its case rotated by 60°.
#[test]
fn the_printed_examples() {
    let standard = lentoax(&mill());
    assert_eq!((standard.status, standard.axind), (0, [3, 2, 1]));
    assert_eq!(
        standard.matrix,
        [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]
    );
    let turned = lentoax(&Query {
        frame: vec![rot('Z', 60.0)],
        ..mill()
    });
    assert_eq!((turned.status, turned.axind), (1, [2, -3, 1]));
    let printed = [
        [0.0, 0.866_025_4, 0.5],
        [0.0, 0.5, -0.866_025_4],
        [1.0, 0.0, 0.0],
    ];
    for (row, wanted) in turned.matrix.iter().zip(printed) {
        for (x, y) in row.iter().zip(wanted) {
            assert!((x - y).abs() < 1e-7, "{:?}", turned.matrix);
        }
    }
}

#[test]
fn the_table_of_values() {
    assert_eq!(asked(|q| q.plane = Plane::G18), (0, [3, 2, 1]));
    assert_eq!(asked(|q| q.plane = Plane::G19), (0, [3, 2, 1]));
    for (angle, wanted) in [
        (30.0, (1, [3, 2, 1])),
        (90.0, (0, [2, -3, 1])),
        (-60.0, (1, [-2, 3, 1])),
    ] {
        assert_eq!(
            asked(|q| q.frame = vec![rot('Z', angle)]),
            wanted,
            "ROT Z{angle}"
        );
    }
    assert_eq!(asked(|q| q.frame = vec![rot('X', 60.0)]), (1, [3, 1, -2]));
    assert_eq!(asked(|q| q.frame = vec![rot('Y', 60.0)]), (1, [-1, 2, 3]));
    for plane in [Plane::G17, Plane::G18, Plane::G19] {
        assert_eq!(
            asked(|q| (q.plane, q.tool_type) = (plane, 500)),
            (0, [2, 1, 3])
        );
    }
    let mirrored = |sd: bool, coord: &str| {
        asked(|q| {
            (q.frame, q.sd42900, q.coord) =
                (vec![Step::Mirror { axis: Axis::X }], sd, coord.to_owned())
        })
    };
    assert_eq!(mirrored(false, "WCS"), (0, [-3, 2, 1]));
    assert_eq!(mirrored(true, "WCS"), (0, [3, 2, 1]));
    assert_eq!(mirrored(true, "TCS"), (0, [-3, 2, 1]));
    assert_eq!(mirrored(false, "TCS"), (0, [3, 2, 1]));
    for (row, wanted) in [
        (18, [2, 1, 3]),
        (19, [1, 3, 2]),
        (-17, [2, 3, 1]),
        (-18, [3, 1, 2]),
        (-19, [1, 2, 3]),
        (5, [3, 2, 1]),
    ] {
        assert_eq!(asked(|q| q.sd42940 = row), (0, wanted), "SD42940 = {row}");
    }
    assert_eq!(asked(|q| (q.sd42950, q.sd42940) = (2, 18)), (0, [1, 3, 2]));
}

#[test]
fn what_is_not_known() {
    let nothing = |query: Query, status: i32| {
        let answer = lentoax(&query);
        assert_eq!(
            (answer.status, answer.axind, answer.matrix),
            (status, [0; 3], [[0.0; 3]; 3])
        );
    };
    nothing(
        Query {
            coord: "XCS".into(),
            ..mill()
        },
        -1,
    );
    nothing(
        Query {
            coord: String::new(),
            ..mill()
        },
        -1,
    );
    nothing(
        Query {
            tool_active: false,
            ..mill()
        },
        -2,
    );
    nothing(
        Query {
            coord: "XCS".into(),
            tool_active: false,
            ..mill()
        },
        -1,
    );
    for coord in ["wcs", "W", "Mcs", "b", "K", "tcs"] {
        assert_eq!(asked(|q| q.coord = coord.to_owned()).0, 0, "{coord}");
    }
}

#[test]
fn a_query_is_not_called_a_job() {
    let message = |value: &Value| {
        lentoax_query(value).unwrap_err().findings[0]
            .message
            .clone()
    };
    assert_eq!(
        message(&Value::Number(7.0)),
        "the query must be an object, not a number"
    );
    assert!(
        message(&Value::Map(vec![("x".to_owned(), Value::Null)]))
            .starts_with("the query has no \"x\"")
    );
}

#[test]
fn nearly_a_quarter_turn_is_one_and_a_tie_goes_to_the_lower_length() {
    assert_eq!(
        asked(|q| q.frame = vec![rot('Z', 90.000_000_000_1)]),
        (0, [2, -3, 1])
    );
    assert_eq!(asked(|q| q.frame = vec![rot('Z', 90.001)]).0, 1);
    // At 45° L2 and L3 share abscissa and ordinate.
    assert_eq!(asked(|q| q.frame = vec![rot('Z', 45.0)]), (1, [2, 2, 1]));
    assert_eq!(
        asked(|q| q.frame = vec![rot('Z', 1e9 * 360.0 + 90.0)]),
        (0, [2, -3, 1])
    );
}

#[test]
fn words_and_nc_lines() {
    assert_eq!(
        sentence(Plane::G17, &lentoax(&mill())).english(),
        "L1 acts along +Z, L2 acts along +Y, L3 acts along +X"
    );
    let turned = lentoax(&Query {
        frame: vec![rot('Z', 60.0)],
        ..mill()
    });
    assert_eq!(
        sentence(Plane::G17, &turned).english(),
        "L1 acts along +1·Z, L2 acts along +0.866·X +0.5·Y, L3 acts along +0.5·X -0.866·Y"
    );
    let lines = |coord: &str| {
        nc_block(&Query {
            coord: coord.to_owned(),
            ..mill()
        })
    };
    assert!(lines("tcs").contains("_STAT=LENTOAX(_AXIND,_MATRIX,\"TCS\")"));
    let hostile = lines("x\")\nM3");
    assert!(
        !hostile.contains("M3") && hostile.contains("_STAT=LENTOAX(_AXIND,_MATRIX,\"?\")"),
        "{hostile}"
    );
}

/// Whether a control with this answer raises the alarm of some lines. It evaluates only their few conditions.
fn alarms(lines: &str, answer: &Answer) -> bool {
    let index =
        |text: &str| -> Vec<usize> { text.split(',').map(|n| n.parse().unwrap()).collect() };
    let holds = |condition: &str| {
        let plain = condition
            .strip_prefix('(')
            .and_then(|c| c.strip_suffix(')'))
            .unwrap_or(condition);
        if let Some(status) = plain.strip_prefix("_STAT<>") {
            return answer.status != status.parse::<i32>().unwrap();
        }
        if let Some((at, number)) = plain
            .strip_prefix("_AXIND[")
            .and_then(|rest| rest.split_once("]<>"))
        {
            return answer.axind[index(at)[0]] != number.parse::<i32>().unwrap();
        }
        let (at, rest) = plain
            .strip_prefix("ABS(_MATRIX[")
            .unwrap()
            .split_once("]-(")
            .unwrap();
        let (value, near) = rest.split_once("))>").unwrap();
        let at = index(at);
        (answer.matrix[at[0]][at[1]] - value.parse::<f64>().unwrap()).abs()
            > near.parse::<f64>().unwrap()
    };
    let conditions: Vec<&str> = lines
        .lines()
        .filter_map(|line| line.strip_prefix("IF "))
        .collect();
    assert!(
        !conditions.is_empty() && lines.matches("SETAL(65000)").count() == conditions.len(),
        "{lines}"
    );
    conditions
        .iter()
        .any(|condition| condition.split(" OR ").any(holds))
}

/// The check required L1 along the tool axis, which a turning tool in G17 never has: it raised its alarm on a correct machine.
#[test]
fn the_check_at_the_control_alarmed_for_every_turning_tool() {
    let turning = Query {
        tool_type: 500,
        frame: vec![rot('Z', 60.0)],
        ..mill()
    };
    assert!(!alarms(&nc_block(&turning), &lentoax(&turning)));
    let questions = [
        mill(),
        turning,
        Query {
            tool_type: 500,
            ..mill()
        },
        Query {
            frame: vec![rot('Z', 90.0)],
            ..mill()
        },
        Query {
            frame: vec![rot('Z', 45.0)],
            ..mill()
        },
        Query {
            frame: vec![rot('X', 30.0), rot('Z', -20.0)],
            ..mill()
        },
        Query {
            sd42940: 18,
            ..mill()
        },
        Query {
            frame: vec![Step::Mirror { axis: Axis::Z }],
            ..mill()
        },
        Query {
            coord: "XCS".into(),
            ..mill()
        },
        Query {
            tool_active: false,
            ..mill()
        },
    ];
    for asked in &questions {
        for other in &questions {
            let differs = lentoax(asked) != lentoax(other);
            assert_eq!(
                alarms(&nc_block(asked), &lentoax(other)),
                differs,
                "{asked:?} {other:?}\n{}",
                nc_block(asked)
            );
        }
    }
}

fn axis() -> impl Strategy<Value = Axis> {
    proptest::sample::select(Axis::ALL.to_vec())
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        (axis(), -720.0..720.0f64).prop_map(|(axis, angle)| Step::Rotation { axis, angle }),
        (axis(), -4..5i32).prop_map(|(axis, quarter)| Step::Rotation {
            axis,
            angle: 90.0 * f64::from(quarter)
        }),
        axis().prop_map(|axis| Step::Mirror { axis }),
    ]
}

/// 0.0022° beyond a half turn: the cosine is 7.5e-10 short of −1, the sine is 3.9e-5. Rounding only one of them made the rows longer than 1.
#[test]
fn a_frame_that_is_all_but_square_keeps_rows_of_length_one() {
    let frame = vec![Step::Rotation {
        axis: Axis::X,
        angle: 540.002_215_372_537_9,
    }];
    let query = Query {
        plane: Plane::G17,
        tool_type: 0,
        frame,
        coord: "WCS".to_owned(),
        tool_active: true,
        sd42900: false,
        sd42940: 0,
        sd42950: 0,
    };
    let Answer { status, matrix, .. } = lentoax(&query);
    assert_eq!(status, 1);
    for row in matrix {
        let square: f64 = row.iter().map(|x| x * x).sum();
        assert!((square - 1.0).abs() < 1e-15, "{row:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// For any frame the matrix is orthonormal, its handedness is that of the frame and the table, the status is 0 exactly
    /// with six zeros and three ±1, and _AXIND can be read from it.
    #[test]
    fn every_frame_gives_an_orthonormal_matrix(
        frame in proptest::collection::vec(step(), 0..6), plane in 0usize..3, tool_type in 0..800i32, sd42900 in any::<bool>(),
        sd42940 in prop_oneof![Just(0), Just(17), Just(18), Just(19), Just(-17), Just(-18), Just(-19), Just(3)], sd42950 in 0..3i32,
        coord in prop_oneof![Just("WCS"), Just("B"), Just("tcs"), Just("MCS"), Just("k")],
    ) {
        let plane = [Plane::G17, Plane::G18, Plane::G19][plane];
        let mirrors = frame.iter().filter(|s| matches!(s, Step::Mirror { .. })).count();
        let query = Query { plane, tool_type, frame, coord: coord.to_owned(), tool_active: true, sd42900, sd42940, sd42950 };
        let Answer { status, axind, matrix: m } = lentoax(&query);
        for i in 0..3 {
            for j in 0..3 {
                let dot: f64 = (0..3).map(|k| m[i][k] * m[j][k]).sum();
                prop_assert!((dot - f64::from(u8::from(i == j))).abs() < 1e-9);
            }
        }
        let det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        // The same tool without a frame shows the handedness of the table; each visible mirror changes it.
        let plain = lentoax(&Query { frame: vec![], ..query.clone() }).matrix;
        let hand = plain[0][0] * (plain[1][1] * plain[2][2] - plain[1][2] * plain[2][1])
            - plain[0][1] * (plain[1][0] * plain[2][2] - plain[1][2] * plain[2][0])
            + plain[0][2] * (plain[1][0] * plain[2][1] - plain[1][1] * plain[2][0]);
        let seen = usize::from(coord == "WCS") + usize::from(sd42900);
        let flips = if seen == 1 { mirrors } else { 0 };
        let sign = if flips % 2 == 0 { 1.0 } else { -1.0 };
        prop_assert!((det - hand * sign).abs() < 1e-9);
        let zeros = m.iter().flatten().filter(|x| **x == 0.0).count();
        let ones = m.iter().flatten().filter(|x| x.abs() == 1.0).count();
        prop_assert_eq!(status == 0, zeros == 6 && ones == 3);
        for (row, index) in m.iter().zip(axind) {
            let j = index.unsigned_abs() as usize - 1;
            prop_assert!(row.iter().all(|x| x.abs() <= row[j].abs() + 1e-9));
            prop_assert_eq!(row[j] < 0.0, index < 0);
        }
        if coord == "tcs" {
            prop_assert_eq!(status, 0);
            prop_assert!(sd42900 || axind.iter().all(|i| *i > 0));
        }
    }
}
