//! Positions of the numbers of touches: close to their contacts, without overlapping.

use crate::geom::Vec2;
use crate::num::within;
use crate::view::camera::{Camera, DOWNWARDS};
use crate::view::label_box::LabelBox;
use crate::view::scene::Scene;

/// Radius of a number's disc, pixels: in a large picture, and in a small one where larger discs would hide the feature.
const DISC: [f64; 2] = [9.0, 8.0];
/// Distance from a contact to the disc.
const OFF: f64 = 7.0;
/// Rings of places beyond the closest one, and the cost of each.
const RINGS: f64 = 2.0;
const RING: f64 = 0.1;
/// Contacts closer than this count as one.
const ONE: f64 = 3.0;

/// The number of a touch, or of several at one position, pixels.
#[derive(Clone, Debug)]
pub struct Number {
    /// Indices of the touches.
    pub touches: Vec<usize>,
    /// Its text: `3`, `3·4`, or `3…9` for more than four; at the first touch of a cycle in a set-up `BORE 1`.
    pub label: String,
    /// The contact; for a touch behind the part the ball.
    pub contact: Vec2,
    /// Its disc, which is elongated for a longer text.
    pub plate: LabelBox,
    /// Whether it is far enough from the contact to need a leader line.
    pub has_leader: bool,
}

/// Numbers of touches at one position that are listed one by one.
const MOST_SAID: usize = 4;

impl Number {
    /// Radius of its disc, pixels.
    pub fn radius(&self) -> f64 {
        self.plate.half.y
    }
}

impl Camera {
    /// Numbers of the touches, in order.
    pub fn numbers(&self, scene: &Scene) -> Vec<Number> {
        let mut numbers = self.contacts(scene);
        let contacts: Vec<Vec2> = numbers.iter().map(|number| number.contact).collect();
        let radius = radius(&contacts);
        // Contacts and the origin stay visible.
        let spots: Vec<Vec2> = contacts
            .into_iter()
            .chain([self.pixel(scene.origin)])
            .collect();
        for k in 0..numbers.len() {
            let (placed, rest) = numbers.split_at_mut(k);
            if let Some(number) = rest.first_mut() {
                self.place_number(number, scene, radius, (placed, &spots));
            }
        }
        numbers
    }

    /// The numbers at their contacts, each with its text. Touches at one position have one number.
    fn contacts(&self, scene: &Scene) -> Vec<Number> {
        let mut numbers: Vec<Number> = Vec::new();
        for (k, touch) in scene.touches.iter().enumerate() {
            // A touch behind the part has its number beside the ball.
            let contact = self.pixel(if touch.behind.is_some() {
                touch.ball
            } else {
                touch.contact
            });
            if let Some(own) = numbers
                .iter_mut()
                .find(|own| own.contact.distance(contact) < ONE)
            {
                own.touches.push(k);
                let number = touch.number.to_string();
                if own.touches.len() > MOST_SAID {
                    own.label = format!("{}…{number}", scene.touches[own.touches[0]].number);
                } else {
                    own.label.push('·');
                    own.label.push_str(&number);
                }
            } else {
                let plate = LabelBox {
                    middle: contact,
                    along: Vec2::X,
                    half: Vec2::ZERO,
                };
                let said = match &touch.named {
                    Some(name) => format!("{name} {}", touch.number),
                    None => touch.number.to_string(),
                };
                numbers.push(Number {
                    touches: vec![k],
                    label: said,
                    contact,
                    plate,
                    has_leader: false,
                });
            }
        }
        numbers
    }

    /// Places the disc of a number so that it covers as few `placed` discs and `spots` as possible.
    fn place_number(
        &self,
        number: &mut Number,
        scene: &Scene,
        radius: f64,
        (placed, spots): (&[Number], &[Vec2]),
    ) {
        let Some(touch) = number.touches.first().map(|k| &scene.touches[*k]) else {
            return;
        };
        // Behind the surface, away from the path: beside it if the surface is seen face on.
        let inward = touch.inward * DOWNWARDS;
        let (way, off) = match touch.behind {
            Some(_) => (inward, scene.radius * self.scale + 2.0),
            None if inward.length() < 0.1 => (Vec2::new(0.7, -0.7), OFF),
            None => (-inward, OFF),
        };
        // About half as wide as its text; a dot has two bytes and is half as wide as a digit; letters are wider.
        let letters = number.label.bytes().filter(u8::is_ascii_alphabetic).count();
        let wide = 2.8 * number.label.len() as f64 + 2.2 * letters as f64 + 4.6;
        let half = Vec2::new((wide * radius / DISC[0]).max(radius), radius);
        // Everything that a place around the contact can cover: no middle of a place is farther from it.
        let farthest = half.x + off + RINGS * (2.0 * radius + 2.0) + radius;
        let around = LabelBox {
            middle: number.contact,
            along: Vec2::X,
            half: half + farthest,
        };
        let plates = placed.iter().map(|other| &other.plate);
        let plates: Vec<&LabelBox> = plates
            .filter(|plate| around.is_near(plate.middle, plate.reach()))
            .collect();
        let spots = spots.iter().copied();
        let spots: Vec<Vec2> = spots.filter(|spot| around.is_near(*spot, 3.0)).collect();
        let mut least = f64::INFINITY;
        // Around the contact, then farther out.
        for step in 0..24 {
            let (ring, turn) = (f64::from(step / 8), f64::from(step % 8));
            let angle = (turn / 2.0).ceil()
                * std::f64::consts::FRAC_PI_4
                * if step % 2 == 0 { 1.0 } else { -1.0 };
            let far = radius + off + ring * (2.0 * radius + 2.0);
            let middle = number.contact
                + Vec2::from_angle(angle).rotate(way) * Vec2::new(far + half.x - radius, far);
            let plate = LabelBox {
                middle,
                along: Vec2::X,
                half,
            };
            let outside = (middle.cmplt(half) | middle.cmpgt(self.size - half))
                .bitmask()
                .count_ones();
            let own = 5.0 * f64::from(outside) + RING * ring;
            if own >= least {
                continue;
            }
            let met = plates.iter().filter(|other| plate.meets(other)).count();
            debug_assert_eq!(
                met,
                placed
                    .iter()
                    .filter(|other| plate.meets(&other.plate))
                    .count(),
                "the quick look finds every plate that this one meets"
            );
            let hidden = spots
                .iter()
                .filter(|spot| plate.covers(**spot, 3.0))
                .count();
            let cost = 10.0 * met as f64 + 3.0 * hidden as f64 + own;
            if cost < least {
                least = cost;
                (number.plate, number.has_leader) = (plate, ring > 0.0);
            }
        }
    }
}

/// Radius of the discs: smaller if contacts are close to each other, or all of them in a small area.
fn radius(contacts: &[Vec2]) -> f64 {
    let (mut nearest, mut widest) = (f64::INFINITY, 0.0_f64);
    for (k, a) in contacts.iter().enumerate() {
        for b in &contacts[..k] {
            nearest = nearest.min(a.distance(*b));
            widest = widest.max(a.distance(*b));
        }
    }
    if contacts.len() < 2 {
        DISC[0]
    } else {
        within((0.45 * nearest).min(0.1 * widest), DISC[1], DISC[0])
    }
}
