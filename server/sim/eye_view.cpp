#include "server/sim/eye_view.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::sim {
namespace {

constexpr double kView_m = 40.0;  ///< farther objects are too small to matter
constexpr double kNear_m = 0.05;
constexpr double kShadow = 0.55;  ///< on undersides: light comes from above

}  // namespace

EyeView::EyeView(const StereoGeometry& geometry, const EyeErrors& errors) : geometry_(geometry), errors_(errors) {
  const double corner = std::hypot(geometry.width_px, geometry.height_px) / 2.0 / geometry.focal_px;
  pad_px_ = 1.0 + std::abs(errors.shift_u_px) + std::abs(errors.shift_v_px) + std::abs(errors.distortion_px) +
            std::abs(errors.roll_rad) * corner * geometry.focal_px;
  distortion_ = errors.distortion_px / geometry.focal_px / (corner * corner * corner);
}

void EyeView::build(const Scene& scene, const CameraPose& eye) {
  eye_ = eye;
  ahead_ = {std::cos(eye.heading_rad), std::sin(eye.heading_rad)};
  left_ = {-ahead_.y(), ahead_.x()};
  patches_.clear();
  borders_.clear();
  find_solids(scene);
  for (std::size_t n = 0; n < seen_.size(); ++n) {
    if (seen_[n] == 0) {
      continue;
    }
    const Solid& solid = scene.solids()[n];
    for (std::size_t f = 0; f < solid.face_count; ++f) {
      const Face& face = scene.faces()[solid.first_face + f];
      if (solid.face_count == 1 || face.normal.dot(eye.position - face.segment.a) > 0.0) {
        add_face(scene, face);
      }
    }
    if (solid.face_count > 1) {
      add_cover(scene, solid);
    }
  }
  add_floor(scene);
  add_people(scene);
}

void EyeView::find_solids(const Scene& scene) {
  seen_.assign(scene.solids().size(), 0);
  const double steepest = geometry_.centre_v_px / geometry_.focal_px;
  for (int u = 0; u < geometry_.width_px; ++u) {
    const Point2 direction = heading_of((geometry_.centre_u_px - u) / geometry_.focal_px).normalized();
    bool closed = false;
    scene.grid().walk(
        eye_.position, direction, kView_m,
        [&](const Crossing& crossing) {
          const Face& face = scene.faces()[crossing.face];
          seen_[static_cast<std::size_t>(face.solid)] = 1;
          const double top_m = eye_.height_m + steepest * crossing.distance_m;
          closed = closed || (face.z_min_m <= 0.0 && face.z_max_m >= std::min(top_m, scene.ceiling_m()));
        },
        [&closed] { return closed; });
  }
}

Linear EyeView::border(const Linear& inverse_depth, const Point2& normal, const Point2& on_border) const {
  // normal . (eye + t ray - on_border) >= 0, divided by t > 0.
  const auto offset = static_cast<float>(normal.dot(eye_.position - on_border));
  return {offset * inverse_depth.c + static_cast<float>(normal.dot(ahead_)),
          offset * inverse_depth.x + static_cast<float>(normal.dot(left_)), offset * inverse_depth.y};
}

bool EyeView::place(Patch& patch, const std::vector<Point2>& corners, double z_low, double z_high) {
  double nearest = kView_m * 10.0;
  double farthest = 0.0;
  for (const Point2& corner : corners) {
    const double depth = ahead_.dot(corner - eye_.position);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  if (farthest < kNear_m) {
    return false;
  }
  nearest = std::max(nearest, kNear_m);
  const auto row_of = [&](double z, double depth) {
    return geometry_.centre_v_px - geometry_.focal_px * (z - eye_.height_m) / depth;
  };
  const double top = std::min(row_of(z_high, nearest), row_of(z_high, farthest)) - pad_px_;
  const double bottom = std::max(row_of(z_low, nearest), row_of(z_low, farthest)) + pad_px_;
  const double rows = geometry_.height_px;
  patch.row_begin = static_cast<int>(std::clamp(top, 0.0, rows)) * kPerPixel;
  patch.row_end = static_cast<int>(std::clamp(std::ceil(bottom), 0.0, rows)) * kPerPixel;
  return patch.row_begin < patch.row_end;
}

void EyeView::add_face(const Scene& scene, const Face& face) {
  Patch patch;
  const Point2& normal = face.normal;
  const double offset = normal.dot(face.segment.a - eye_.position);
  if (offset == 0.0 || !place(patch, {face.segment.a, face.segment.b()}, face.z_min_m, face.z_max_m)) {
    return;
  }
  patch.inverse_depth = {static_cast<float>(normal.dot(ahead_) / offset),
                         static_cast<float>(normal.dot(left_) / offset), 0.0F};
  patch.corner = face.segment.a;
  patch.axis = face.segment.direction;
  patch.length_m = face.segment.length_m;
  patch.plane_m = std::abs(offset);
  patch.z_min_m = face.z_min_m;
  patch.z_max_m = face.z_max_m;
  patch.paint = &face.paint;
  patch.pattern = PatternScale::make(face.paint.pattern, face.paint.feature_m);
  if (face.picture != kNoPicture) {
    patch.picture = &scene.pictures()[static_cast<std::size_t>(face.picture)];
  }
  patch.first_border = static_cast<std::uint32_t>(borders_.size());
  borders_.push_back(border(patch.inverse_depth, patch.axis, face.segment.a));
  borders_.push_back(border(patch.inverse_depth, -patch.axis, face.segment.b()));
  const auto over_low = static_cast<float>(eye_.height_m - face.z_min_m);
  const auto under_high = static_cast<float>(face.z_max_m - eye_.height_m);
  const Linear& d = patch.inverse_depth;
  borders_.push_back({over_low * d.c, over_low * d.x, 1.0F});
  borders_.push_back({under_high * d.c, under_high * d.x, -1.0F});
  patch.borders = static_cast<std::uint32_t>(borders_.size()) - patch.first_border;
  patches_.push_back(patch);
}

void EyeView::add_cover(const Scene& scene, const Solid& solid) {
  const bool above = eye_.height_m > solid.z_max_m;
  if (!above && eye_.height_m >= solid.z_min_m) {
    return;
  }
  const double z = above ? solid.z_max_m : solid.z_min_m;
  std::vector<Point2> corners;
  corners.reserve(solid.face_count);
  for (std::size_t f = 0; f < solid.face_count; ++f) {
    corners.push_back(scene.faces()[solid.first_face + f].segment.a);
  }
  Patch patch;
  if (!place(patch, corners, z, z)) {
    return;
  }
  patch.upright = false;
  patch.inverse_depth = {0.0F, 0.0F, static_cast<float>(1.0 / (z - eye_.height_m))};
  patch.corner = corners.front();
  patch.axis = scene.faces()[solid.first_face].segment.direction;
  patch.plane_m = std::abs(z - eye_.height_m);
  patch.light = above ? 1.0 : kShadow;
  patch.paint = &solid.cover;
  patch.pattern = PatternScale::make(solid.cover.pattern, solid.cover.feature_m);
  patch.first_border = static_cast<std::uint32_t>(borders_.size());
  for (std::size_t f = 0; f < solid.face_count; ++f) {
    const Face& face = scene.faces()[solid.first_face + f];
    borders_.push_back(border(patch.inverse_depth, -face.normal, face.segment.a));
  }
  patch.borders = static_cast<std::uint32_t>(solid.face_count);
  patches_.push_back(patch);
}

void EyeView::add_floor(const Scene& scene) {
  Patch patch;
  patch.upright = false;
  patch.inverse_depth = {0.0F, 0.0F, static_cast<float>(-1.0 / eye_.height_m)};
  patch.row_end = geometry_.height_px * kPerPixel;
  patch.plane_m = eye_.height_m;
  patch.paint = &scene.floor();
  patch.pattern = PatternScale::make(scene.floor().pattern, scene.floor().feature_m);
  patches_.push_back(patch);
}

void EyeView::add_people(const Scene& scene) {
  person_faces_.clear();
  for (const Disc& disc : scene.moving()) {
    const std::vector<Point2> corners = cylinder_corners(disc.centre, disc.radius_m);
    double distance_m = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      Face face;
      face.segment = Segment::between(corners[i], corners[(i + 1) % corners.size()]);
      face.normal = {face.segment.direction.y(), -face.segment.direction.x()};
      face.z_max_m = disc.height_m;
      face.paint = disc.paint;
      face.paint.along0_m = distance_m;
      distance_m += face.segment.length_m;
      if (face.normal.dot(eye_.position - face.segment.a) > 0.0) {
        person_faces_.push_back(face);
      }
    }
  }
  for (const Face& face : person_faces_) {
    add_face(scene, face);
  }
}

void EyeView::look(int sample_row, SampleRow& row) const {
  const auto samples = static_cast<std::size_t>(geometry_.width_px * kPerPixel);
  row.ray_x.resize(samples);
  row.ray_y.resize(samples);
  row.inverse_depth.assign(samples, static_cast<float>(1.0 / kMaxWorldSide_m));
  row.patch.assign(samples, SampleRow::kNothing);
  constexpr double kStep_px = 1.0 / kPerPixel;
  const auto at_px = [](int sample) { return (sample + 0.5) * kStep_px - 0.5; };
  const double v = at_px(sample_row) - errors_.shift_v_px;
  const double y = (geometry_.centre_v_px - v) / geometry_.focal_px;
  for (std::size_t i = 0; i < samples; ++i) {
    const double u = at_px(static_cast<int>(i)) - errors_.shift_u_px;
    const double x = (geometry_.centre_u_px - u) / geometry_.focal_px;
    const double radial = 1.0 - distortion_ * (x * x + y * y);
    row.ray_x[i] = static_cast<float>(x * radial + errors_.roll_rad * y);
    row.ray_y[i] = static_cast<float>(y * radial - errors_.roll_rad * x);
  }
  for (std::size_t n = 0; n < patches_.size(); ++n) {
    if (sample_row >= patches_[n].row_begin && sample_row < patches_[n].row_end) {
      fill(patches_[n], static_cast<std::int32_t>(n), static_cast<float>(y), row);
    }
  }
}

void EyeView::fill(const Patch& patch, std::int32_t index, float y, SampleRow& row) const {
  // The span of ray_x between the borders, for the row's y give or take the errors of the eye.
  const auto slack = static_cast<float>(pad_px_ / geometry_.focal_px);
  const auto half_view = static_cast<float>(geometry_.width_px / geometry_.focal_px);
  float low = -half_view;
  float high = half_view;
  const Linear* const first = borders_.data() + patch.first_border;
  const Linear* const last = first + patch.borders;
  for (const Linear* b = first; b != last; ++b) {
    const float rest = b->c + b->y * y + std::abs(b->y) * slack;
    if (b->x > 0.0F) {
      low = std::max(low, -rest / b->x);
    } else if (b->x < 0.0F) {
      high = std::min(high, -rest / b->x);
    } else if (rest < 0.0F) {
      return;
    }
  }
  const int samples = geometry_.width_px * kPerPixel;
  const auto sample_of = [&](float x) {
    return (geometry_.centre_u_px - geometry_.focal_px * static_cast<double>(x)) * kPerPixel;
  };
  const double pad = pad_px_ * kPerPixel;
  const auto begin = static_cast<std::size_t>(std::clamp<double>(sample_of(high) - pad, 0.0, samples));
  const auto end = static_cast<std::size_t>(std::clamp<double>(sample_of(low) + pad, 0.0, samples));
  for (std::size_t i = begin; i < end; ++i) {
    const float ray_x = row.ray_x[i];
    const float ray_y = row.ray_y[i];
    const float inverse_depth = patch.inverse_depth.at(ray_x, ray_y);
    bool inside = inverse_depth > row.inverse_depth[i] && inverse_depth < static_cast<float>(1.0 / kNear_m);
    for (const Linear* b = first; inside && b != last; ++b) {
      inside = b->at(ray_x, ray_y) >= 0.0F;
    }
    if (inside) {
      row.inverse_depth[i] = inverse_depth;
      row.patch[i] = index;
    }
  }
}

}  // namespace seeker::sim
