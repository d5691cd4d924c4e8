#include "tests/bench/speed/peers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <sstream>

namespace pastefit {

namespace {

const std::filesystem::path kDecks = std::filesystem::path(PASTEFIT_SOURCE_DIR) / "tests/bench/peers";

/// Rolling springs of the peers that ask for a number: as stiff as ours in a contact that carries a few grains.
constexpr double kTypicalOverlap = 0.005;  // of the radius

struct Numbers {
  double effective_radius, effective_modulus, roll_stiffness, pull;
};

Numbers numbers_of(const ContactModel& m, double radius) {
  Numbers n{};
  n.effective_radius = 0.5 * radius;
  n.effective_modulus = 0.5 * m.youngs_modulus_pa / (1 - m.poissons_ratio * m.poissons_ratio);
  const double stiffness = 2 * n.effective_modulus * std::sqrt(n.effective_radius * kTypicalOverlap * radius);
  n.roll_stiffness = 2.25 * m.rolling_friction * m.rolling_friction * stiffness;
  n.pull = m.bridge.shape == BridgeShape::none ? 0 : m.bridge.c_n;
  return n;
}

Peer lammps(const ContactModel& m, const Numbers& n, double skin) {
  const std::string elastic =
      decimal(m.youngs_modulus_pa) + " " + decimal(m.restitution) + " " + decimal(m.poissons_ratio);
  const std::string rest = " tangential mindlin NULL 1.0 " + decimal(m.friction) + " damping tsuji rolling sds " +
                           decimal(n.roll_stiffness) + " 0.01 " + decimal(m.rolling_friction);
  const std::string dry = "hertz/material " + elastic + rest;
  Peer peer{Peer::TimedEngine::lammps, "lammps", "lmp", "lammps", "granular: hertz/material, mindlin, rolling sds", {}};
  std::string grains = dry;
  if (n.pull > 0) {
    peer.laws = "granular: dmt, mindlin, rolling sds";
    grains = "dmt " + elastic + " " + decimal(n.pull / (4 * std::numbers::pi * n.effective_radius)) + rest;
  }
  peer.variables = {{"grain_law", grains}, {"wall_law", dry}, {"skin", decimal(skin)}};
  return peer;
}

Peer lammps_jkr(Peer peer, const ContactModel& m, const Numbers& n) {
  peer.name = "lammps-jkr";
  peer.laws = "granular: jkr, mindlin, rolling sds";
  std::string& law = peer.variables[0].second;
  law = "jkr " + decimal(m.youngs_modulus_pa) + " " + decimal(m.restitution) + " " + decimal(m.poissons_ratio) + " " +
        decimal(n.pull / (3 * std::numbers::pi * n.effective_radius)) + law.substr(law.find(" tangential"));
  return peer;
}

Peer liggghts(std::string name, const std::string& cohesion, const std::string& rolling, const ContactModel& m,
              const Numbers& n, double radius, double skin) {
  Peer peer{Peer::TimedEngine::liggghts, std::move(name), "liggghts", "liggghts", "", {}};
  peer.laws = "hertz, tangential history, " + (cohesion.empty() ? "" : cohesion + ", ") + rolling;
  const std::string contact = "model hertz tangential history", roll = " rolling_friction " + rolling;
  // Where the pull c holds two grains together without load.
  const double depth = std::pow(0.75 * n.pull / (n.effective_modulus * std::sqrt(n.effective_radius)), 2.0 / 3.0);
  const double density = n.pull > 0 ? n.pull / (2 * std::numbers::pi * n.effective_radius * depth) : 0;
  const double gap = n.pull > 0 ? -m.bridge.d_c_m : 0.1 * radius;
  peer.variables = {{"grain_law", contact + (cohesion.empty() ? "" : " cohesion " + cohesion) + roll},
                    {"wall_law", contact + roll},
                    {"skin", decimal(skin)},
                    {"youngs_modulus", decimal(m.youngs_modulus_pa)},
                    {"poissons_ratio", decimal(m.poissons_ratio)},
                    {"restitution", decimal(m.restitution)},
                    {"friction", decimal(m.friction)},
                    {"rolling_friction", decimal(m.rolling_friction)},
                    {"cohesion_density", decimal(density)},
                    {"liquid_percent", "1"},
                    {"surface_tension", decimal(std::max(n.pull, 1e-6) / (2 * std::numbers::pi * radius))},
                    {"separation_ratio", decimal(1 + 0.5 * gap / radius)},
                    {"decks", kDecks.string()}};
  return peer;
}

Peer yade(const ContactModel& m, const Numbers& n, double radius, double skin) {
  Peer peer{Peer::TimedEngine::yade, "yade", "yade", "yade", "MindlinPhys with moments", {}};
  if (n.pull > 0) peer.laws += " and DMT adhesion";
  peer.variables = {{"youngs_modulus", decimal(m.youngs_modulus_pa)},
                    {"poissons_ratio", decimal(m.poissons_ratio)},
                    {"restitution", decimal(m.restitution)},
                    {"friction", decimal(m.friction)},
                    {"roll_stiffness", decimal(n.roll_stiffness * n.effective_radius * n.effective_radius)},
                    {"roll_limit", decimal(m.rolling_friction * n.effective_radius / radius)},
                    {"surface_energy", decimal(n.pull / (4 * std::numbers::pi * n.effective_radius))},
                    {"skin", decimal(0.4 * skin)}};
  return peer;
}

}  // namespace

std::vector<Peer> peers_of(const ContactModel& m, double radius, double skin) {
  const Numbers n = numbers_of(m, radius);
  const Peer first = lammps(m, n, skin);
  if (n.pull == 0)
    return {first, liggghts("liggghts", "", "cdt", m, n, radius, skin),
            liggghts("liggghts-epsd", "", "epsd", m, n, radius, skin), yade(m, n, radius, skin)};
  return {first, lammps_jkr(first, m, n), liggghts("liggghts", "sjkr", "cdt", m, n, radius, skin),
          liggghts("liggghts-capillary", "easo/capillary/viscous", "cdt", m, n, radius, skin),
          yade(m, n, radius, skin)};
}

std::vector<std::string> command_of(const Peer& peer, std::string_view deck, const Variables& variables) {
  const bool yade = peer.engine == Peer::TimedEngine::yade;
  std::vector<std::string> command{peer.program};
  const auto add = [&](std::initializer_list<std::string> words) { command.insert(command.end(), words); };
  if (yade) {
    add({"-j1", "-n", "-x", (kDecks / "yade" / deck).string() + ".py"});
  } else {
    if (peer.engine == Peer::TimedEngine::lammps) add({"-nocite"});
    const char* folder = peer.engine == Peer::TimedEngine::lammps ? "lammps" : "liggghts";
    add({"-log", "none", "-in", (kDecks / folder / deck).string() + ".in"});
  }
  for (const Variables* group : {&variables, &peer.variables})
    for (const auto& [name, value] : *group) {
      if (!yade) add({"-var"});
      add({name, value});
    }
  return command;
}

std::optional<double> number_after(const std::string& output, std::string_view label) {
  std::optional<double> last;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(label)) continue;
    const char* start = line.c_str() + label.size();
    char* end = nullptr;
    const double value = std::strtod(start, &end);
    if (end != start) last = value;
  }
  return last;
}

namespace {

/// Seconds an engine sleeps while it starts, until its message passing is ready [s]: no part of its loop's share.
double idle_start(const Peer& peer) {
  static const double idle = [&] {
    const ChildResult empty = run_program({peer.program, "-log", "none", "-in", "/dev/null"}, 60);
    return std::max(empty.wall_s - empty.processor_s, 0.0);
  }();
  return idle;
}

}  // namespace

std::optional<double> loop_seconds(const Peer& peer, const ChildResult& run) {
  if (!run.ok) return {};
  if (peer.engine == Peer::TimedEngine::yade) return number_after(run.output, "Loop seconds ");
  const std::optional<double> wall = number_after(run.output, "Loop time of ");
  if (!wall) return {};
  if (peer.engine == Peer::TimedEngine::liggghts)
    return *wall * std::min(run.processor_s / (run.wall_s - idle_start(peer)), 1.0);
  const std::size_t share = run.output.rfind("% CPU use");
  if (share == std::string::npos) return {};
  const std::size_t line = run.output.rfind('\n', share) + 1;
  return *wall * std::strtod(run.output.c_str() + line, nullptr) / 100;
}

std::string decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

}  // namespace pastefit
