#include "apps/element/element_pictures.h"

#include "apps/run/ranks.h"
#include "dem/continuum/particle_stress.h"

#include <cmath>

namespace mergel::apps {

namespace {

const std::vector<Frames::Kind> kinds{
    {"particles", "vtp"}, {"bonds", "vtp"}, {"contacts", "vtp"}};

} // namespace

ElementPictures::ElementPictures(const std::filesystem::path& folder, const ElementCase& c,
                                 dem::ElementTest& run)
    : when_(c.pictures), every_(c.picture_every), run_(run),
      size_last_(run.assembly().cell.size)
{
  on_first_rank([&] { frames_.emplace(folder, kinds); });
  if (when_ != ElementCase::Pictures::none) take_picture();
}

ElementPictures::ElementPictures(const std::filesystem::path& folder, const ElementCase& c,
                                 dem::ElementTest& run,
                                 const std::filesystem::path& earlier,
                                 const dem::State& state)
    : when_(c.pictures), every_(c.picture_every), run_(run)
{
  const auto& x = state.get<double>("picture_x_0", 3);
  for (std::size_t k = 0; k < x.size(); k += 3) x_0_.emplace_back(x[k], x[k + 1], x[k + 2]);
  if (!x_0_.empty() && x_0_.size() != run.assembly().particles.size())
    dem::State::refuse("picture_x_0", "has another number of particles");
  const auto& size = state.get_rows<double>("picture_size", 3);
  size_last_ = {size[0], size[1], size[2]};
  on_first_rank([&] { frames_.emplace(folder, kinds, earlier, state); });
}

void ElementPictures::save(dem::State& state) const
{
  std::vector<double> x;
  for (const dem::Vec3& x_0 : x_0_) x.insert(x.end(), {x_0.x(), x_0.y(), x_0.z()});
  state.add_common("picture_x_0", std::move(x), 3);
  state.add_common<double>("picture_size",
                           {size_last_.x(), size_last_.y(), size_last_.z()});
  Frames::save(state, frames_ ? &*frames_ : nullptr);
}

std::string ElementPictures::check(const std::filesystem::path& folder,
                                   const dem::State& state)
{
  return Frames::check(folder, kinds, state);
}

bool ElementPictures::update(bool stage_ends)
{
  if (when_ == ElementCase::Pictures::none) return false;
  const dem::Vec3 grown = run_.assembly().cell.size.cwiseQuotient(size_last_);
  const bool is_strained = when_ == ElementCase::Pictures::strain &&
                           grown.array().log().abs().maxCoeff() >= every_;
  if (!stage_ends && !is_strained) return false;
  take_picture();
  return true;
}

void ElementPictures::take_picture()
{
  dem::Assembly& mine = run_.assembly();
  mine.partition.gather_motion(mine.particles, mine.comm);
  if (x_0_.empty())
    for (const dem::ParticleState& b : mine.particles.state) x_0_.push_back(b.x);
  size_last_ = mine.cell.size;
  const auto branches = dem::loaded_branches(mine);
  const dem::FrameFiles frame(
      {mine, x_0_, branches, dem::even_porosity(mine.particles, mine.cell.volume()), {}});
  dem::AssemblyFiles files;
  on_first_rank([&] { files = {frames_->file(0), frames_->file(1), frames_->file(2)}; });
  write_together(frame, files, [] {});
  on_first_rank([&] { frames_->add(run_.state().time); });
}

} // namespace mergel::apps
