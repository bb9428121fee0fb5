//! Hidden lines, contours and cast shadows: against rays through every triangle and closed forms.

mod cast_shadows;
mod closed_forms;
mod coincident_faces;
mod contour_validity;
mod dual_space_search;
mod hidden_line_precedence;
mod locality;
mod smooth_contours;
mod thin_folds;
mod torus_contours;
mod visibility_by_rays;
