//! Blocks of the 4xx cycles: head, parameters in the order of the posts, and the dialog texts of posted programs.

use crate::control::Request;
use crate::control::iso::writer::Writer;
use crate::control::native::heidenhain::row;
use crate::num::decimal;
use crate::path::Quantity;

/// The text beside a parameter.
fn dialog(number: u16, q: u16) -> &'static str {
    match q {
        247 => "STEPPING ANGLE",
        260 => "CLEARANCE HEIGHT",
        261 => "MEASURING HEIGHT",
        262 => "NOMINAL DIAMETER",
        263 => "1ST POINT 1ST AXIS",
        264 => "1ST POINT 2ND AXIS",
        265 => "2ND POINT 1ST AXIS",
        266 => "2ND POINT 2ND AXIS",
        267 => "TRAVERSE DIRECTION",
        272 => "MEASURING AXIS",
        273 | 321 => "CENTER IN 1ST AXIS",
        274 | 322 => "CENTER IN 2ND AXIS",
        275 | 277 | 288 => "MAXIMUM DIMENSION",
        276 | 278 | 289 => "MINIMUM DIMENSION",
        279 => "TOLERANCE 1ST CENTER",
        280 => "TOLERANCE 2ND CENTER",
        281 => "MEASURING LOG",
        282 => "1ST SIDE LENGTH",
        283 | 324 => "2ND SIDE LENGTH",
        284 => "MAX. LIMIT 1ST SIDE",
        285 => "MIN. LIMIT 1ST SIDE",
        286 => "MAX. LIMIT 2ND SIDE",
        287 => "MIN. LIMIT 2ND SIDE",
        294 => "1ST POINT 3RD AXIS",
        301 => "MOVE TO CLEARANCE",
        303 => "MEAS. VALUE TRANSFER",
        305 => "NUMBER IN TABLE",
        309 => "PGM-STOP IF ERROR",
        310 => "OFFS. 2ND MEASUREMNT",
        311 if number == 408 => "SLOT WIDTH",
        311 if number == 409 => "RIDGE WIDTH",
        311 => "NOMINAL LENGTH",
        320 => "SET-UP CLEARANCE",
        323 => "FIRST SIDE LENGTH",
        325 => "STARTING ANGLE",
        328 => "STARTNG PNT 1ST AXIS",
        329 => "STARTNG PNT 2ND AXIS",
        330 => "TOOL NUMBER",
        339 => "DATUM NUMBER",
        365 => "TYPE OF TRAVERSE",
        381 => "PROBE IN TS AXIS",
        382 => "1ST CO. FOR TS AXIS",
        383 => "2ND CO. FOR TS AXIS",
        384 => "3RD CO. FOR TS AXIS",
        423 => "NO. OF MEAS. POINTS",
        _ => "DATUM",
    }
}

/// Writes a cycle. A parameter whose value follows a result is set to the Q parameter that holds it.
pub(super) fn write(
    w: &mut Writer<'_>,
    request: &Request<'_>,
    number: u16,
    (parameters, shifted): (&[(u16, Quantity)], &[Option<usize>]),
) {
    match number {
        247 => w.line("CYCL DEF 247 DATUM SETTING ~"),
        _ => {
            let head = row(number).map_or("", |row| row.head);
            w.parts(&["TCH PROBE ", &number.to_string(), " ", head, " ~"]);
        }
    }
    for (i, (q, quantity)) in parameters.iter().enumerate() {
        let continues = if i + 1 < parameters.len() { " ~" } else { "" };
        let value = match (shifted[i], quantity) {
            (Some(holds), _) => format!("Q{holds}"),
            (None, Quantity::Length(mm) | Quantity::Feed(mm)) => {
                decimal(mm / request.scale, request.post.decimals(request.scale))
            }
            (None, Quantity::Angle(degrees)) => decimal(*degrees, 4),
            (None, Quantity::Plain(x)) => decimal(*x, 0),
        };
        let sign = if value.starts_with('-') { "" } else { "+" };
        w.continued(&format!(
            "    Q{q}={sign}{value} ;{}{continues}",
            dialog(number, *q)
        ));
    }
}
