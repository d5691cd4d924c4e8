#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/text.h"
#include "calibrate/exports/application.h"
#include "calibrate/exports/liggghts_deck.h"

namespace pastefit {

namespace {

std::string in_deck(const Vec3& v) {
  return format("%.9g %.9g %.9g", v.x, v.y, v.z);
}

Vec3 unit_vector(const Vec3& v) {
  return (1 / norm(v)) * v;
}

/// Columns of figures.csv: each is a variable of the deck.
struct FigureColumns {
  std::string variables, values, names;

  void add(const std::string& name, const std::string& formula) {
    variables += "variable     " + name + " equal " + formula + "\n";
    values += (values.empty() ? "${" : ",${") + name + "}";
    names += (names.empty() ? "" : ",") + name;
  }
};

/// Distance of a grain from a plane, along its normal, as a formula of the deck.
std::string distance_formula(const OrientedPlane& plane) {
  const Vec3 n = unit_vector(plane.normal);
  return format("(x-(%.9g))*(%.9g)+(y-(%.9g))*(%.9g)", plane.point_m.x, n.x, plane.point_m.y, n.y) +
         format("+(z-(%.9g))*(%.9g)", plane.point_m.z, n.z);
}

/// The mass on the inner side of the outlet.
std::string mass_inside(const Application& application) {
  if (!application.outlet) return "variable     inside equal mass(all)\n";
  return "variable     beyond atom " + distance_formula(*application.outlet) +
         "\nvariable     inner atom mass*(v_beyond<0)\ncompute      inner all reduce sum v_inner\n"
         "variable     inside equal c_inner\n";
}

/// Grains that fill a layer evenly are at half its depth on average.
std::string depth_formula(const DepthGauge& gauge, FigureColumns& columns) {
  const Vec3& at = gauge.floor.point_m;
  const std::string square = format("(x-(%.9g))^2+(y-(%.9g))^2+(z-(%.9g))^2", at.x, at.y, at.z);
  std::string before =
      "variable     above atom " + distance_formula(gauge.floor) +
      format("\nvariable     near atom (%s-v_above^2<%.9g)*(v_above>0)\n", square, gauge.radius_m * gauge.radius_m) +
      "variable     height atom v_above*v_near\n"
      "compute      near all reduce sum v_near\ncompute      height all reduce sum v_height\n";
  columns.add("flow_depth_m", "2*c_height/(c_near+1e-9)");
  return before;
}

/// What pastefit kpi reads.
FigureColumns figure_columns(const Application& application) {
  FigureColumns columns;
  const std::string inside = mass_inside(application);
  columns.add("time_s", format("step*dt-(%.9g)", application.start_s()));
  columns.add("end_s", format("%.9g", application.duration_s - application.start_s()));
  columns.add("fed_kg", "f_feed[2]");
  columns.add("inside_kg", "v_inside");
  if (!application.outlet) columns.add("lost_kg", "f_feed[2]-v_inside");  // nothing leaves it but what escapes
  std::string before = inside;
  if (application.depth) before += depth_formula(*application.depth, columns);
  for (const MachinePart& part : application.parts) {
    const std::string mesh = "f_part_" + part.name;
    columns.add(part.name + "_force_n", "sqrt(" + mesh + "[1]^2+" + mesh + "[2]^2+" + mesh + "[3]^2)");
    if (!part.rotation) continue;
    const Vec3 axis = unit_vector(part.rotation->axis);
    columns.add(part.name + "_torque_n_m", mesh + format("[4]*(%.9g)+", axis.x) + mesh + format("[5]*(%.9g)+", axis.y) +
                                               mesh + format("[6]*(%.9g)", axis.z));
  }
  columns.variables = before + columns.variables;
  return columns;
}

std::string meshes(const Application& application) {
  std::string out;
  int type = 2;
  for (const MachinePart& part : application.parts) {
    out += "fix          part_" + part.name + " all mesh/surface/stress file " + part.name +
           format(".stl type %d", type++);
    if (part.rotation) out += " reference_point " + in_deck(part.rotation->point_m);
    out += "\n";
  }
  return out;
}

/// Runs between the starts and ends of the motions.
std::string runs(const Application& application, double time_step) {
  const auto step_at = [&](double time) { return std::lround(time / time_step); };
  std::multimap<long, std::string> events;
  for (const MachinePart& part : application.parts) {
    const std::string move = "fix          move_" + part.name + " all move/mesh mesh part_" + part.name;
    if (const auto& slide = part.slide) {
      events.emplace(step_at(slide->from_s), move + " linear " + in_deck(slide->velocity_m_s) + "\n");
      events.emplace(step_at(slide->until_s()), "unfix        move_" + part.name + "\n");
    }
    if (const auto& rotation = part.rotation) {
      const double speed = rotation->revolutions_per_min / 60;
      events.emplace(step_at(rotation->from_s), move + " rotate origin " + in_deck(rotation->point_m) + " axis " +
                                                    in_deck((speed < 0 ? -1.0 : 1.0) * rotation->axis) +
                                                    format(" period %.9g\n", 1 / std::fabs(speed)));
    }
  }
  events.emplace(step_at(application.duration_s), "");
  std::string out;
  long before = 0;
  for (const auto& [step, commands] : events) {
    if (step > before) out += format("run          %ld upto\n", step);
    out += commands;
    before = std::max(before, step);
  }
  return out;
}

/// Disc of the feed, across its velocity.
std::string feed_stl(const Feed& feed) {
  constexpr int sectors = 24;
  const Vec3 normal = unit_vector(feed.velocity_m_s);
  const Vec3 any = std::fabs(normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 along = unit_vector(cross(any, normal)), across = cross(normal, along);
  const auto rim = [&](int sector) {
    const double angle = 2 * std::numbers::pi * sector / sectors;
    return feed.centre_m + feed.radius_m * (std::cos(angle) * along + std::sin(angle) * across);
  };
  std::vector<Triangle> disc;
  for (int n = 0; n < sectors; ++n) disc.push_back({feed.centre_m, rim(n), rim((n + 1) % sectors)});
  return stl_text("feed", disc);
}

/// One template for each class of sizes, and the share of each.
std::pair<std::string, std::string> templates(const ExportScene& scene) {
  constexpr std::array seeds{15485863, 15485867, 15485917, 15485927, 15485933, 15485941, 15485959, 15485989};  // primes
  const SizeClasses& sizes = scene.sizes;
  std::string fixes, shares = std::to_string(sizes.radii_m.size());
  for (std::size_t n = 0; n < sizes.radii_m.size(); ++n) {
    fixes += format("fix          grain%zu all particletemplate/sphere %d atom_type 1 ", n + 1, seeds[n]) +
             format("density constant %.9g radius constant %.9g\n", scene.grain_density_kg_m3, sizes.radii_m[n]);
    const auto count = std::ranges::count(sizes.class_of, static_cast<int>(n));
    const double share =
        sizes.class_of.empty() ? 1 : static_cast<double>(count) / static_cast<double>(sizes.class_of.size());
    shares += format(" grain%zu %.9g", n + 1, share);
  }
  return {fixes, shares};
}

}  // namespace

std::vector<ExportFile> liggghts_application(const ExportScene& scene, const Written& written, const Models& models,
                                             const std::vector<std::string>& notes) {
  const Application& application = *scene.application;
  const double largest = std::ranges::max(scene.sizes.radii_m), extrude = 8 * largest;
  const std::pair<Vec3, Vec3> bounds = application.bounds();
  const Vec3 behind = application.feed.centre_m - extrude * unit_vector(application.feed.velocity_m_s);
  const double margin = std::max(application.feed.radius_m, 8 * largest);
  const auto side = [&](double Vec3::*of) {
    return format("%.6g %.6g ", std::min(bounds.first.*of, behind.*of) - margin,
                  std::max(bounds.second.*of, behind.*of) + margin);
  };
  const auto every = [&](double seconds) {
    return std::to_string(std::max(1L, std::lround(seconds / written.time_step_s)));
  };
  const FigureColumns columns = figure_columns(application);
  const auto [fixes, shares] = templates(scene);
  std::string names;
  for (const MachinePart& part : application.parts) names += " part_" + part.name;
  const std::string deck = filled_in(
      "exports/texts/liggghts_application.in",
      {{"header", liggghts_begin(scene, "the machine: " + application.title, notes)},
       {"use", yields(scene.contact().normal)
                   ? "liggghts -in in.application, on one process"
                   : "liggghts -in in.application, or mpirun -np 2 liggghts -in in.application"},
       {"box", side(&Vec3::x) + side(&Vec3::y) + side(&Vec3::z)},
       {"types", std::to_string(scene.walls().size() + 1)},
       {"skin", shown(0.8 * largest)},
       {"time_step", shown(written.time_step_s)},
       {"parts", meshes(application)},
       {"meshes", std::to_string(application.parts.size()) + " meshes" + names},
       {"wall_end", models.wall_end()},
       {"templates", fixes},
       {"classes", shares},
       {"mass", exact(application.feed.mass_kg)},
       {"rate", exact(application.feed.rate_kg_s)},
       {"velocity", in_deck(application.feed.velocity_m_s)},
       {"extrude", shown(extrude)},
       {"figures", columns.variables},
       {"every", every(0.01)},
       {"values", columns.values},
       {"columns", columns.names},
       {"thermo", every(0.1)},
       {"dumps", "# dump       frames all custom " + every(0.05) + " frame_*.dump id type x y z radius vx vy vz"},
       {"runs", runs(application, written.time_step_s)}});
  std::vector<ExportFile> files{{"in.application", deck}, {"feed-disc.stl", feed_stl(application.feed)}};
  for (const MachinePart& part : application.parts)
    files.push_back({part.name + ".stl", stl_text(part.name, part.triangles)});
  return files;
}

}  // namespace pastefit
