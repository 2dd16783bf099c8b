// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/exchange.h"

#include "base/units.h"
#include "base/vtp_file.h"
#include "specimen/whole_file.h"

namespace bondlab {

namespace {

std::vector<Particle> particles_of(const PackingFile &packing) {
  std::vector<Particle> particles;
  for (const PackingRow &row : packing.rows) particles.push_back(row.particle);
  return particles;
}

std::vector<Particle> read_vtk(const std::filesystem::path &file) {
  const VtpData data = read_vtk_points(file);
  const VtpArray *size = nullptr;
  double factor = 1;
  for (const char *name : {"radius", "radius_m", "r"})
    if (!size) size = data.find(name);
  for (const char *name : {"diameter", "diameter_m"})
    if (!size && (size = data.find(name))) factor = 0.5;
  if (!size || size->components != 1) {
    std::vector<std::string> names;
    for (const VtpArray &array : data.point_data) names.push_back(array.name);
    throw UserError(Place{file.string(), 0, 0},
                    "no radius at the points (allowed: an array radius, radius_m, r, diameter or "
                    "diameter_m); there are: " +
                        join(names));
  }
  std::vector<Particle> particles;
  for (std::size_t i = 0; i < data.size(); ++i)
    particles.push_back({data.points[3 * i], data.points[3 * i + 1], data.points[3 * i + 2],
                         factor * size->values[i]});
  return particles;
}

}  // namespace

std::string xyzr_text(const std::vector<Particle> &particles) {
  std::string text = "# x y z r (m)\n";
  for (const Particle &p : particles)
    text += canonical_number(p.x) + " " + canonical_number(p.y) + " " + canonical_number(p.z) +
            " " + canonical_number(p.r) + "\n";
  return text;
}

std::string packing_vtp_text(const std::vector<Particle> &particles) {
  VtpData data;
  VtpArray radius{"radius_m", 1, false, {}}, diameter{"diameter_m", 1, false, {}},
      id{"id", 1, true, {}};
  for (const Particle &p : particles) {
    data.points.insert(data.points.end(), {p.x, p.y, p.z});
    radius.values.push_back(p.r);
    diameter.values.push_back(2 * p.r);
    id.values.push_back(static_cast<double>(id.values.size() + 1));
  }
  data.point_data = {id, radius, diameter};
  return vtp_text(data);
}

void export_packing(const PackingFile &packing, const std::filesystem::path &out) {
  const std::string form = out.extension().string();
  if (form == ".vtp")
    write_specimen_file(out, packing_vtp_text(particles_of(packing)));
  else if (form == ".xyzr" || form == ".txt")
    write_specimen_file(out, xyzr_text(particles_of(packing)));
  else
    throw UserError("--out is " + out.string() +
                    " (allowed: a name that ends in .vtp, .xyzr or .txt)");
}

Specimen import_packing(const std::filesystem::path &file, const SpecimenRequest &request) {
  const std::string form = file.extension().string();
  if (form == ".vtp" || form == ".vtu") return packing_in(request, read_vtk(file));
  if (form == ".data") return packing_in(request, particles_of(read_packing_file(file)));
  return read_xyzr(file, request);
}

}  // namespace bondlab
