#include "tests/support/catch.h"

#include "apps/view/pile/section_image.h"

#include "dem/error.h"

#include <cmath>
#include <limits>

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

using namespace mergel;
using namespace mergel::apps;

namespace {

/// Three by two points, 0.5 mm apart from (1, -2) on, with values 0, 1, 2 below 10, 11, none.
vtkSmartPointer<vtkImageData> fields()
{
  auto data = vtkSmartPointer<vtkImageData>::New();
  data->SetDimensions(3, 1, 2);
  data->SetOrigin(1.0, 0.0, -2.0);
  data->SetSpacing(0.5, 0.5, 0.5);
  vtkNew<vtkDoubleArray> values;
  values->SetName("q [Pa]");
  for (const double value : {0.0, 1.0, 2.0, 10.0, 11.0}) values->InsertNextValue(value);
  values->InsertNextValue(std::numeric_limits<double>::quiet_NaN());
  data->GetPointData()->AddArray(values);
  return data;
}

const Window everywhere{0.0, 0.0, 100.0, 100.0};

} // namespace

TEST_CASE("A section has its values at its points, and blends those around", "[unit][view]")
{
  const auto data = fields();
  const SectionValues q(data, "q [Pa]", 1, component(0, 2.0));
  CHECK(q.n_x() == 3);
  CHECK(q.n_z() == 2);
  CHECK(q.x(2) == Approx(2.0));
  CHECK(q.z(1) == Approx(-1.5));
  CHECK(q.at(1, 1) == 22.0);
  CHECK(std::isnan(q.at(3, 0)));
  CHECK(q.between(0.5, 0.0) == Approx(1.0));
  CHECK(q.between(0.25, 0.5) == Approx(0.5 * (0.5 + 20.5)));
  CHECK(q.between(-0.4, 0.0) == Approx(0.0)); // half a cell beyond the last point
}

TEST_CASE("A section has no value where the nearest point has none", "[unit][view]")
{
  const auto data = fields();
  const SectionValues q(data, "q [Pa]", 1, component(0));
  CHECK(std::isnan(q.between(1.8, 0.9)));
  CHECK(q.between(1.4, 1.0) == Approx(11.0)); // of those that have one
}

TEST_CASE("The quantile of a section counts the points of the window that have a value",
          "[unit][view]")
{
  const auto data = fields();
  const SectionValues q(data, "q [Pa]", 1, component(0));
  CHECK(q.quantile(0.0, everywhere) == 0.0);
  CHECK(q.quantile(0.5, everywhere) == 2.0);
  CHECK(q.quantile(1.0, everywhere) == 11.0);
  CHECK(q.quantile(1.0, {1.5, -2.0, 2.0, 0.4}) == 2.0); // the lower points
  CHECK(q.quantile(0.5, {50.0, 50.0, 1.0, 1.0}) == 0.0);
}

TEST_CASE("An array that the fields lack is named", "[unit][view]")
{
  const auto data = fields();
  CHECK_THROWS_WITH(SectionValues(data, "p [Pa]", 1, component(0)),
                    mergel::match::Contains("no point array 'p [Pa]'"));
  CHECK_THROWS_AS(SectionValues(data, "q [Pa]", 3, component(0)), InputError);
}

TEST_CASE("A colour bar ends at 1, 2 or 5 times a power of ten", "[unit][view]")
{
  CHECK(round_above(0.3) == Approx(0.5));
  CHECK(round_above(1.0) == Approx(1.0));
  CHECK(round_above(1.01) == Approx(2.0));
  CHECK(round_above(51.0) == Approx(100.0));
  CHECK(round_above(0.0) == 1.0);
}
