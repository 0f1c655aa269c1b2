/// \file
/// The solids that a recogniser distinguishes (spec S6, in the order of the paper's Table 2).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace seeker {

enum class SolidKind : std::uint8_t { kSphere, kTriangularPrism, kQuadrangularPrism, kEllipsoid };
inline constexpr std::array kSolidKinds{SolidKind::kSphere, SolidKind::kTriangularPrism, SolidKind::kQuadrangularPrism,
                                        SolidKind::kEllipsoid};

[[nodiscard]] constexpr std::string_view to_string(SolidKind solid) {
  switch (solid) {
    case SolidKind::kSphere: return "sphere";
    case SolidKind::kTriangularPrism: return "triangular-prism";
    case SolidKind::kQuadrangularPrism: return "quadrangular-prism";
    case SolidKind::kEllipsoid: return "ellipsoid";
  }
  return "sphere";
}

/// The solid of this name; std::nullopt for any other name.
[[nodiscard]] constexpr std::optional<SolidKind> solid_named(std::string_view name) {
  for (const SolidKind solid : kSolidKinds) {
    if (to_string(solid) == name) {
      return solid;
    }
  }
  return std::nullopt;
}

[[nodiscard]] constexpr bool is_prism(SolidKind solid) {
  return solid == SolidKind::kTriangularPrism || solid == SolidKind::kQuadrangularPrism;
}

}  // namespace seeker
