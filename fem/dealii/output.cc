#include "fem/dealii/output.h"

#include <deal.II/fe/fe_dgq.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace mergel::fem {

namespace {

/// Add a text as field data, which deal.II does not write: the codes of its letters, ended by 0.
void add_field_data(std::string& vtu, const std::string& name, const std::string& text)
{
  const std::string before = "<UnstructuredGrid>";
  const auto at = vtu.find(before);
  if (at == std::string::npos) throw std::logic_error("write_vtu: no grid in the file");
  std::string data = "\n<FieldData>\n<DataArray type=\"String\" Name=\"" + name +
                     "\" NumberOfTuples=\"1\" format=\"ascii\">\n";
  for (const char c : text) data += std::to_string(static_cast<unsigned char>(c)) + " ";
  vtu.insert(at + before.size(), data + "0\n</DataArray>\n</FieldData>");
}

} // namespace

void write_vtu(const ElasticSolid& solid, const NodalField& u, const NodalField& v,
               const std::string& path, const std::string& made_by)
{
  using dealii::DataComponentInterpretation::component_is_part_of_tensor;
  using dealii::DataComponentInterpretation::component_is_part_of_vector;

  const auto unknowns = [&](const NodalField& field) {
    dealii::Vector<double> vector(solid.dofs().n_dofs());
    for (unsigned int i = 0; i < vector.size(); ++i) vector(i) = field(i % 3, i / 3);
    return vector;
  };
  const dealii::Vector<double> displacement = unknowns(u), velocity = unknowns(v);

  // ParaView needs a tensor as nine components; it is constant in a cell.
  const dealii::FESystem<3> constant(dealii::FE_DGQ<3>(0), 9);
  dealii::DoFHandler<3> stress_dofs(solid.dofs().get_triangulation());
  stress_dofs.distribute_dofs(constant);
  dealii::Vector<double> stress(stress_dofs.n_dofs());
  const auto cell_stress = solid.cell_stress(u);
  std::vector<dealii::types::global_dof_index> indices(9);
  for (const auto& cell : stress_dofs.active_cell_iterators()) {
    cell->get_dof_indices(indices);
    for (unsigned int c = 0; c < 9; ++c)
      stress(indices[c]) = cell_stress[cell->active_cell_index()][c / 3][c % 3];
  }

  const std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>
      vector(3, component_is_part_of_vector), tensor(9, component_is_part_of_tensor);
  dealii::DataOut<3> out;
  out.add_data_vector(solid.dofs(), displacement,
                      std::vector<std::string>(3, "displacement"), vector);
  out.add_data_vector(solid.dofs(), velocity, std::vector<std::string>(3, "velocity"),
                      vector);
  out.add_data_vector(stress_dofs, stress, std::vector<std::string>(9, "stress"), tensor);
  dealii::DataOutBase::VtkFlags flags;
  flags.print_date_and_time = false; // a repeated run gives the same file
  out.set_flags(flags);
  out.build_patches();

  // Not directly to the file: deal.II reports a failed stream with a long text and a stack.
  std::ostringstream text;
  out.write_vtu(text);
  std::string vtu = text.str();
  if (!made_by.empty()) add_field_data(vtu, "made by", made_by);
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file << vtu;
  file.close();
  if (!file)
    throw std::runtime_error(
        "far field output " + path +
        ": cannot be written: " + std::generic_category().message(errno) +
        ". Check that the folder exists, its permissions, and the free space of the disk.");
}

} // namespace mergel::fem
