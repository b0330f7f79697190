//! The cycles of the family, one file each.

pub mod boss;
pub mod double_wall_external_corner;
pub mod double_wall_internal_corner;
pub mod external_rectangle;
pub mod groove;
pub mod groove_protected;
pub mod hole;
pub mod hole_protected;
pub mod internal_rectangle;
pub mod internal_rectangle_protected;
pub mod nc_action;
pub mod probe_on_off;
pub mod surface;
pub mod triple_wall_external_corner;
pub mod triple_wall_internal_corner;
pub mod wall_angle;
pub mod web;
pub mod web_three_points;
