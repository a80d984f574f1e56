#include "apps/view/results.h"

#include "apps/view/round_off.h"
#include "dem/error.h"
#include "dem/io/readable.h"
#include "dem/io/vtk.h"

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

constexpr double mm_per_m = 1e3;

/// Collects the error messages of VTK: many kinds of damage are reported in this way only.
class VtkErrors : public vtkOutputWindow {
public:
  static VtkErrors* New();
  void DisplayText(const char* text) override { text_ += text; }
  const std::string& text() const { return text_; }

private:
  std::string text_;
};
vtkStandardNewMacro(VtkErrors);

/// During its lifetime error messages of VTK are collected instead of printed.
class ErrorCollector {
public:
  ErrorCollector()
  {
    vtkOutputWindow::SetInstance(complaints_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ErrorCollector(const ErrorCollector&) = delete;
  ErrorCollector& operator=(const ErrorCollector&) = delete;
  ~ErrorCollector()
  {
    vtkOutputWindow::SetInstance(before_);
    vtkLogger::SetStderrVerbosity(verbosity_before_);
  }
  bool heard() const { return !complaints_->text().empty(); }

private:
  vtkSmartPointer<vtkOutputWindow> before_ = vtkOutputWindow::GetInstance();
  vtkLogger::Verbosity verbosity_before_ = vtkLogger::GetCurrentVerbosityCutoff();
  vtkNew<VtkErrors> complaints_;
};

void scale(vtkDataArray* lengths)
{
  for (vtkIdType k = 0; k < lengths->GetNumberOfTuples(); ++k)
    for (int c = 0; c < lengths->GetNumberOfComponents(); ++c)
      lengths->SetComponent(k, c, mm_per_m * lengths->GetComponent(k, c));
}

vtkDataArray* require_array(vtkDataSet* data, const char* name, int components,
                            const fs::path& file)
{
  vtkDataArray* array = data->GetPointData()->GetArray(name);
  require(array != nullptr && array->GetNumberOfComponents() == components,
          file.string() + ": no point array '" + name + "' with " +
              std::to_string(components) + " component(s). Was it written by mergel?");
  return array;
}

/// A file without points.
enum class Empty { refused, allowed };

/// The data set of a .vtp, .vtu or .vti in mm.
template <class Reader>
auto read(const fs::path& file, Empty empty = Empty::refused)
{
  require(dem::is_readable(file),
          file.string() + ": does not exist, though the series lists it. Copy the whole "
                          "results folder, 'fields' included.");
  vtkNew<Reader> reader;
  const ErrorCollector listener;
  reader->SetFileName(file.c_str());
  reader->Update();
  auto* output = reader->GetOutput();
  require(!listener.heard() && reader->GetErrorCode() == vtkErrorCode::NoError,
          file.string() + ": is damaged or no VTK file. Copy it again or repeat the run.");
  require(empty == Empty::allowed || output->GetNumberOfPoints() > 0,
          file.string() + ": holds no points.");
  vtkSmartPointer<std::remove_pointer_t<decltype(output)>> data = output;
  if constexpr (std::is_same_v<std::remove_pointer_t<decltype(output)>, vtkImageData>) {
    const double *x = data->GetOrigin(), *h = data->GetSpacing();
    data->SetOrigin(mm_per_m * x[0], mm_per_m * x[1], mm_per_m * x[2]);
    data->SetSpacing(mm_per_m * h[0], mm_per_m * h[1], mm_per_m * h[2]);
  } else if (data->GetNumberOfPoints() > 0) {
    scale(data->GetPoints()->GetData());
  }
  return data;
}

std::vector<dem::SeriesEntry> series(const fs::path& pvd)
{
  const ErrorCollector listener; // read_series throws instead
  auto entries = dem::read_series(pvd);
  require(!entries.empty(), pvd.string() + ": lists no file yet.");
  return entries;
}

/// The file of this series written at `time` [s].
fs::path file_at(double time, const fs::path& pvd)
{
  for (const dem::SeriesEntry& entry : series(pvd))
    if (std::abs(entry.time - time) <= round_off * std::abs(time))
      return pvd.parent_path() / entry.file;
  throw InputError(pvd.string() + ": has no file at " + std::to_string(time) +
                   " s, as particles.pvd has. Choose another --frame.");
}

/// The entry of this number in particles.pvd, and its number from 0.
std::pair<dem::SeriesEntry, std::size_t> entry_of(const fs::path& folder, int number)
{
  dem::require_folder(folder);
  const auto entries = series(folder / "particles.pvd");
  const int n = static_cast<int>(entries.size());
  const int chosen = number < 0 ? n + number : number;
  require(chosen >= 0 && chosen < n, "--frame " + std::to_string(number) + ": " +
                                         (folder / "particles.pvd").string() +
                                         " has frames 0 to " + std::to_string(n - 1) + ".");
  const auto k = static_cast<std::size_t>(chosen);
  return {entries[k], k};
}

vtkSmartPointer<vtkPolyData> read_particles(const fs::path& file)
{
  vtkSmartPointer<vtkPolyData> particles = read<vtkXMLPolyDataReader>(file);
  scale(require_array(particles, "radius", 1, file));
  require_array(particles, "damage", 1, file);
  require_array(particles, "id", 1, file);
  return particles;
}

} // namespace

ResultFrame read_frame(const fs::path& folder, int number)
{
  const auto [entry, k] = entry_of(folder, number);
  ResultFrame frame;
  frame.number = k;
  frame.time = entry.time;
  frame.particles = read_particles(folder / entry.file);
  frame.pile = read<vtkXMLPolyDataReader>(file_at(frame.time, folder / "pile.pvd"));

  const fs::path far_field = file_at(frame.time, folder / "far_field.pvd");
  frame.far_field = read<vtkXMLUnstructuredGridReader>(far_field);
  scale(require_array(frame.far_field, "displacement", 3, far_field));
  return frame;
}

ContinuumFrame read_continuum(const fs::path& folder, double time)
{
  ContinuumFrame frame;
  if (!dem::is_readable(folder / "fields.pvd")) return frame;
  frame.section = read<vtkXMLImageDataReader>(file_at(time, folder / "fields.pvd"));
  const fs::path contacts = file_at(time, folder / "contacts.pvd");
  frame.contacts = read<vtkXMLPolyDataReader>(contacts);
  require(frame.contacts->GetCellData()->GetArray("normal force [N]") != nullptr,
          contacts.string() +
              ": no cell array 'normal force [N]'. Was it written by mergel?");
  return frame;
}

SpecimenFrame read_specimen(const fs::path& folder, int number)
{
  const dem::SeriesEntry entry = entry_of(folder, number).first;
  SpecimenFrame frame;
  frame.time = entry.time;
  frame.particles = read_particles(folder / entry.file);
  frame.platens = read<vtkXMLPolyDataReader>(file_at(frame.time, folder / "platens.pvd"));
  if (dem::is_readable(folder / "membrane.pvd"))
    frame.membrane =
        read<vtkXMLPolyDataReader>(file_at(frame.time, folder / "membrane.pvd"));
  return frame;
}

DiscFrame read_disc(const fs::path& folder, int number)
{
  const dem::SeriesEntry entry = entry_of(folder, number).first;
  DiscFrame frame;
  frame.time = entry.time;
  frame.particles = read_particles(folder / entry.file);
  frame.plates = read<vtkXMLPolyDataReader>(file_at(frame.time, folder / "plates.pvd"));
  const fs::path breaks = file_at(frame.time, folder / "breaks.pvd");
  frame.breaks = read<vtkXMLPolyDataReader>(breaks, Empty::allowed);
  if (frame.breaks->GetNumberOfPoints() == 0) {
    frame.breaks = nullptr;
    return frame;
  }
  scale(require_array(frame.breaks, "radius", 1, breaks));
  require_array(frame.breaks, "mode", 1, breaks);
  require_array(frame.breaks, "normal", 3, breaks);
  return frame;
}

} // namespace mergel::apps
