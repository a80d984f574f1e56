#include "apps/view/pile/displacement.h"

#include "dem/error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace mergel::apps {

namespace {

/// |a_p - b_q| for every p of `now`, where q = partner(p).
template <class Partner>
vtkSmartPointer<vtkDoubleArray> distances(vtkDataArray* now, vtkDataArray* before,
                                          const Partner& partner)
{
  auto result = vtkSmartPointer<vtkDoubleArray>::New();
  result->SetName(displacement_array);
  result->SetNumberOfTuples(now->GetNumberOfTuples());
  for (vtkIdType p = 0; p < now->GetNumberOfTuples(); ++p) {
    const vtkIdType q = partner(p);
    const auto moved = [&](int c) {
      return now->GetComponent(p, c) - before->GetComponent(q, c);
    };
    result->SetValue(p, std::hypot(moved(0), moved(1), moved(2)));
  }
  return result;
}

} // namespace

double add_displacement(const ResultFrame& start, ResultFrame& frame)
{
  vtkDataArray* start_id = start.particles->GetPointData()->GetArray("id");
  vtkDataArray* id = frame.particles->GetPointData()->GetArray("id");
  std::unordered_map<std::int64_t, vtkIdType> at_start;
  for (vtkIdType p = 0; p < start_id->GetNumberOfTuples(); ++p)
    at_start.emplace(std::llround(start_id->GetTuple1(p)), p);

  const auto same_particle = [&](vtkIdType p) {
    const auto found = at_start.find(std::llround(id->GetTuple1(p)));
    require(found != at_start.end(), "particle " +
                                         std::to_string(std::llround(id->GetTuple1(p))) +
                                         " of frame " + std::to_string(frame.number) +
                                         " is not in frame 0: the folder mixes two runs.");
    return found->second;
  };
  const auto moved = distances(frame.particles->GetPoints()->GetData(),
                               start.particles->GetPoints()->GetData(), same_particle);
  frame.particles->GetPointData()->AddArray(moved);

  vtkDataArray* u = frame.far_field->GetPointData()->GetArray("displacement");
  vtkDataArray* u_start = start.far_field->GetPointData()->GetArray("displacement");
  require(u->GetNumberOfTuples() == u_start->GetNumberOfTuples(),
          "the far field has " + std::to_string(u->GetNumberOfTuples()) +
              " points in frame " + std::to_string(frame.number) + " and " +
              std::to_string(u_start->GetNumberOfTuples()) +
              " in frame 0: the folder mixes two runs.");
  frame.far_field->GetPointData()->AddArray(
      distances(u, u_start, [](vtkIdType p) { return p; }));
  std::vector<double> sorted(moved->Begin(), moved->End());
  const auto k = static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + k, sorted.end());
  return sorted[static_cast<std::size_t>(k)];
}

} // namespace mergel::apps
