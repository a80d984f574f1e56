#include "apps/view/label.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mergel::apps {

namespace {

// all in units of the page
constexpr double text_size = 0.75;
constexpr double letter = 11.0;      // mean width at that size
constexpr double half_height = 11.0; // of the gap
constexpr double enough_room = 60.0; // more does not make a place better

double distance(const Pixel& a, const Pixel& b)
{
  return std::hypot(a.x - b.x, a.y - b.y);
}

} // namespace

CurveLabels::CurveLabels(Page& page, const Box& box, const Pixel& origin)
    : page_(page), box_(box), origin_(origin)
{
}

std::size_t CurveLabels::add_curve(std::vector<Pixel> points)
{
  curves_.push_back(std::move(points));
  return curves_.size() - 1;
}

void CurveLabels::write(std::size_t curve, const std::string& words)
{
  const double u = page_.unit();
  const double half = 0.5 * letter * static_cast<double>(words.size()) * u;
  Place place = freest(curves_[curve], curve, half);
  const bool has_gap = place.room > half;
  if (!has_gap) place = freest(outside(curve, half), curve, half);
  if (!has_gap && !(place.room > 0.75 * half)) return;

  const Pixel& p = place.at;
  if (has_gap)
    page_.fill({p.x - half, p.y - half_height * u, p.x + half, p.y + half_height * u},
               {1.0, 1.0, 1.0});
  page_.text(p, words, {text_size});
  for (const double end : {-half, 0.0, half}) crowd_.push_back({p.x + end, p.y});
}

double CurveLabels::room_at(const Pixel& p, std::size_t curve) const
{
  double room = enough_room * page_.unit();
  for (const Pixel& other : crowd_) room = std::min(room, distance(p, other));
  for (std::size_t k = 0; k < curves_.size(); ++k) {
    if (k == curve) continue;
    for (const Pixel& other : curves_[k]) room = std::min(room, distance(p, other));
  }
  return room;
}

/// Of places with equal room the nearest to the middle.
CurveLabels::Place CurveLabels::freest(const std::vector<Pixel>& places, std::size_t curve,
                                       double half) const
{
  const double u = page_.unit(), margin = half + 3.0 * u, foot = 14.0 * u;
  Place best;
  double best_score = -1e300;
  const std::size_t middle = places.size() / 2;
  for (std::size_t k = 0; k < places.size(); k += 4) {
    const Pixel& p = places[k];
    const bool is_inside = p.x - margin > box_.left && p.x + margin < box_.right &&
                           p.y - foot > box_.bottom && p.y + foot < box_.top;
    if (!is_inside) continue;
    const double room = room_at(p, curve);
    const double off = static_cast<double>(k > middle ? k - middle : middle - k);
    const double score = room - 0.01 * u * off;
    if (score <= best_score) continue;
    best_score = score;
    best = {p, room};
  }
  return best;
}

/// Places beside a curve that is nearer to them than any other.
std::vector<Pixel> CurveLabels::outside(std::size_t curve, double half) const
{
  const double u = page_.unit();
  const auto nearest = [](const Pixel& p, const std::vector<Pixel>& points) {
    double smallest = 1e300;
    for (const Pixel& other : points) smallest = std::min(smallest, distance(p, other));
    return smallest;
  };
  std::vector<Pixel> places;
  for (const Pixel& p : curves_[curve]) {
    const double r = distance(p, origin_);
    if (!(r > 0.0)) continue;
    const double x = (p.x - origin_.x) / r, y = (p.y - origin_.y) / r;
    const double off = half * std::abs(x) + half_height * u * std::abs(y) + 3.0 * u;
    const Pixel place{p.x + off * x, p.y + off * y};
    const double own = nearest(place, curves_[curve]);
    bool is_own = true;
    for (std::size_t k = 0; k < curves_.size(); ++k)
      is_own = is_own && (k == curve || own < nearest(place, curves_[k]));
    if (is_own) places.push_back(place);
  }
  return places;
}

} // namespace mergel::apps
