#include "dem/io/vtk.h"

#include "dem/error.h"
#include "dem/io/atomic_file.h"
#include "dem/io/grid_file.h"
#include "dem/io/readable.h"
#include "dem/version.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <stdexcept>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUtilities.h>

namespace mergel::dem {

namespace fs = std::filesystem;

namespace {

vtkSmartPointer<vtkPoints> points(const std::vector<Vec3>& x)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataTypeToDouble();
  result->SetNumberOfPoints(static_cast<vtkIdType>(x.size()));
  for (std::size_t p = 0; p < x.size(); ++p)
    result->SetPoint(static_cast<vtkIdType>(p), x[p].data());
  return result;
}

/// Cells of n points each, all of them below n_points.
template <std::size_t n>
vtkSmartPointer<vtkCellArray> cells(const std::vector<std::array<Index, n>>& corners,
                                    std::size_t n_points, const fs::path& file)
{
  vtkNew<vtkIdTypeArray> corner_ids;
  corner_ids->SetNumberOfValues(static_cast<vtkIdType>(n * corners.size()));
  vtkIdType k = 0;
  for (const auto& cell : corners)
    for (const Index p : cell) {
      if (p >= n_points)
        throw std::logic_error(file.string() + ": a cell names point " + std::to_string(p) +
                               ", but there are " + std::to_string(n_points) + ".");
      corner_ids->SetValue(k++, p);
    }
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->SetData(static_cast<vtkIdType>(n), corner_ids);
  return result;
}

void add_fields(const std::vector<Field>& fields, std::size_t n, const fs::path& file,
                vtkDataSetAttributes* target)
{
  std::set<std::string> names;
  for (const Field& field : fields) {
    if (field.components < 1 ||
        field.values.size() != n * static_cast<std::size_t>(field.components))
      throw std::logic_error(file.string() + ": field '" + field.name + "' has " +
                             std::to_string(field.values.size()) + " values, but " +
                             std::to_string(n) + " x " + std::to_string(field.components) +
                             " are needed.");
    if (!names.insert(field.name).second)
      throw std::logic_error(file.string() + ": two fields are named '" + field.name +
                             "'.");

    vtkNew<vtkDoubleArray> values;
    values->SetName(field.name.c_str());
    values->SetNumberOfComponents(field.components);
    values->SetNumberOfTuples(static_cast<vtkIdType>(n));
    std::copy(field.values.begin(), field.values.end(), values->GetPointer(0));
    target->AddArray(values);
  }
}

/// Composed in memory and written by replace_file(): the writer of VTK 9.1 does not check
/// that its last buffer reached the disk.
template <class Writer, class Data>
void write(const fs::path& file, Data* data)
{
  vtkNew<vtkStringArray> made_by;
  made_by->SetName("made by");
  made_by->InsertNextValue(program_text());
  data->GetFieldData()->AddArray(made_by);
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1 || writer->GetErrorCode() != vtkErrorCode::NoError)
    throw NumericalError(file.string() + ": cannot be composed: " +
                         vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()) +
                         ".");
  replace_file(file, writer->GetOutputString());
}

/// `text` inside a quoted XML attribute.
std::string escaped(const std::string& text)
{
  std::string result;
  for (const char c : text) switch (c) {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '"':
      result += "&quot;";
      break;
    default:
      result += c;
    }
  return result;
}

/// 15 digits if they read back as the same number, else 17.
std::string to_text(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.15g", value);
  if (std::strtod(text, nullptr) != value) std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

} // namespace

void write_points(const fs::path& file, const std::vector<Vec3>& x,
                  const std::vector<Field>& point_fields)
{
  std::vector<std::array<Index, 1>> vertices(x.size());
  for (std::size_t p = 0; p < x.size(); ++p) vertices[p] = {static_cast<Index>(p)};

  vtkNew<vtkPolyData> data;
  data->SetPoints(points(x));
  data->SetVerts(cells(vertices, x.size(), file));
  add_fields(point_fields, x.size(), file, data->GetPointData());
  write<vtkXMLPolyDataWriter>(file, data.Get());
}

void write_lines(const fs::path& file, const std::vector<Vec3>& x,
                 const std::vector<std::array<Index, 2>>& lines,
                 const std::vector<Field>& line_fields)
{
  vtkNew<vtkPolyData> data;
  data->SetPoints(points(x));
  data->SetLines(cells(lines, x.size(), file));
  add_fields(line_fields, lines.size(), file, data->GetCellData());
  write<vtkXMLPolyDataWriter>(file, data.Get());
}

void write_surface(const fs::path& file, const std::vector<Vec3>& x,
                   const std::vector<std::array<Index, 3>>& triangles,
                   const std::vector<Field>& point_fields)
{
  vtkNew<vtkPolyData> data;
  data->SetPoints(points(x));
  data->SetPolys(cells(triangles, x.size(), file));
  add_fields(point_fields, x.size(), file, data->GetPointData());
  write<vtkXMLPolyDataWriter>(file, data.Get());
}

std::size_t PointGrid::size() const
{
  std::size_t product = 1;
  for (const int along : n) product *= static_cast<std::size_t>(along);
  return product;
}

void write_grid(const fs::path& file, const PointGrid& grid,
                const std::vector<Field>& point_fields)
{
  vtkNew<vtkImageData> data;
  data->SetDimensions(grid.n.data());
  data->SetOrigin(grid.origin.data());
  data->SetSpacing(grid.h, grid.h, grid.h);
  add_fields(point_fields, grid.size(), file, data->GetPointData());
  write<vtkXMLImageDataWriter>(file, data.Get());
}

Series::Series(fs::path pvd, std::vector<SeriesEntry> earlier)
    : pvd_(std::move(pvd)), entries_(std::move(earlier))
{
}

void Series::add(double time, const fs::path& file)
{
  const fs::path folder = fs::absolute(pvd_).lexically_normal().parent_path();
  entries_.push_back(
      {time, fs::absolute(file).lexically_normal().lexically_proximate(folder)});
  try {
    write();
  } catch (...) {
    entries_.pop_back();
    throw;
  }
}

void Series::write() const
{
  if (entries_.empty()) {
    fs::remove(pvd_);
    return;
  }
  std::string text = "<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"Collection\" version=\"1.0\">\n"
                     "  <Collection>\n";
  for (const SeriesEntry& entry : entries_)
    text += "    <DataSet timestep=\"" + to_text(entry.time) + "\" part=\"0\" file=\"" +
            escaped(entry.file.generic_string()) + "\"/>\n";
  text += "  </Collection>\n</VTKFile>\n";

  replace_file(pvd_, text);
}

std::vector<SeriesEntry> read_series(const fs::path& pvd)
{
  require_readable(pvd);
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
      vtkXMLUtilities::ReadElementFromFile(pvd.c_str()));
  vtkXMLDataElement* collection =
      root == nullptr ? nullptr : root->FindNestedElementWithName("Collection");
  require(collection != nullptr,
          pvd.string() + ": is not a ParaView collection (.pvd), or is damaged.");

  std::vector<SeriesEntry> entries;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement* data_set = collection->GetNestedElement(k);
    SeriesEntry entry;
    const char* name = data_set->GetAttribute("file");
    require(name != nullptr && data_set->GetScalarAttribute("timestep", entry.time) == 1,
            pvd.string() + ": entry " + std::to_string(k) +
                " lacks a time step or a file name.");
    entry.file = name;
    entries.push_back(std::move(entry));
  }
  return entries;
}

} // namespace mergel::dem
