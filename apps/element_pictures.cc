#include "apps/element_pictures.h"

#include "apps/ranks.h"
#include "dem/distribute.h"
#include "dem/io/rock_fields.h"

#include <cmath>
#include <cstdio>

namespace mergel::apps {

namespace {

/// Rows of the tensors, tension positive.
dem::Field stress_field(const dem::Rock& rock)
{
  dem::Field field{"stress", 9, {}};
  for (const dem::Mat3& sigma : dem::grain_stresses(rock))
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) field.values.push_back(sigma(a, b));
  return field;
}

} // namespace

ElementPictures::ElementPictures(std::filesystem::path folder, const ElementCase& c,
                                 ElementRun& run)
    : folder_(std::move(folder)), when_(c.pictures), every_(c.picture_every), run_(run),
      size_taken_(run.rock().cell.size), particles_(folder_ / "particles.pvd"),
      bonds_(folder_ / "bonds.pvd")
{
  if (when_ != ElementCase::Pictures::none) take();
}

void ElementPictures::look(bool leg_ends)
{
  if (when_ == ElementCase::Pictures::none) return;
  const dem::Vec3 grown = run_.rock().cell.size.cwiseQuotient(size_taken_);
  const bool is_strained = when_ == ElementCase::Pictures::strain &&
                           grown.array().log().abs().maxCoeff() >= every_;
  if (leg_ends || is_strained) take();
}

void ElementPictures::take()
{
  const dem::Rock rock = dem::whole(run_.rock());
  if (x_0_.empty())
    for (const dem::Body& b : rock.particles.body) x_0_.push_back(b.x);
  size_taken_ = rock.cell.size;
  on_first_rank([&] {
    const auto file = [&](const char* kind) {
      char name[64];
      std::snprintf(name, sizeof name, "%s_%04zu.vtp", kind, particles_.entries().size());
      return folder_ / "fields" / name;
    };
    std::filesystem::create_directories(folder_ / "fields");
    const double time = run_.state().time;
    const auto particles = file("particles"), bonds = file("bonds");
    dem::write_particles(particles, rock, x_0_, {stress_field(rock)});
    dem::write_bonds(bonds, rock);
    particles_.add(time, particles);
    bonds_.add(time, bonds);
  });
}

} // namespace mergel::apps
