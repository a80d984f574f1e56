/// Labels on curves, where there is room for them.
#pragma once

#include "apps/view/page.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mergel::apps {

/// Labels of the curves of one panel.
///
/// A label is placed in a gap of its curve, as far as possible from all other curves,
/// labels and points to avoid. Where there is too little room it is placed just outside the
/// curve, seen from the origin, if no other curve is nearer there; otherwise it is left
/// out.
class CurveLabels {
public:
  /// @param box    that contains all labels
  /// @param origin around which the curves run
  CurveLabels(Page& page, const Box& box, const Pixel& origin);

  void avoid(const Pixel& point) { crowd_.push_back(point); }

  /// A curve that is already drawn. Add all before the first label.
  std::size_t add_curve(std::vector<Pixel> points);

  void write(std::size_t curve, const std::string& words);

private:
  struct Place {
    Pixel at;
    double room = -1.0; ///< distance to the nearest obstacle; negative: no place
  };

  double room_at(const Pixel& p, std::size_t curve) const;
  Place freest(const std::vector<Pixel>& places, std::size_t curve, double half) const;
  std::vector<Pixel> outside(std::size_t curve, double half) const;

  Page& page_;
  Box box_;
  Pixel origin_;
  std::vector<Pixel> crowd_;
  std::vector<std::vector<Pixel>> curves_;
};

} // namespace mergel::apps
