#pragma once

#include <cstdint>
#include <vector>

#include "core/world/contacts.h"
#include "core/world/particles.h"

namespace pastefit {

/// What acts between grains, by how much work it takes: contacts in full, bridges by their distance only.
struct Interactions {
  Contacts contacts;
  Bridges bridges;
};

/// Pairs near enough that they may meet before the list is made again.
class Candidates {
 public:
  std::vector<std::int32_t> i, j;

  std::size_t size() const { return i.size(); }
  void clear();

  // Where the pair's memory is kept now.
  bool is_contact(std::size_t c) const { return place_[c] >= 0; }
  bool is_bridge(std::size_t c) const { return place_[c] < kNone; }
  std::int32_t index(std::size_t c) const { return place_[c] >= 0 ? place_[c] : kNone - 1 - place_[c]; }

  std::int32_t place(std::size_t c) const { return place_[c]; }

  void add(std::int32_t a, std::int32_t b, std::int32_t place);
  void set_contact(std::size_t c, std::int32_t k) { place_[c] = k; }
  void set_bridge(std::size_t c, std::int32_t k) { place_[c] = kNone - 1 - k; }
  void set_none(std::size_t c) { place_[c] = kNone; }
  static constexpr std::int32_t kNone = -1;

 private:
  std::vector<std::int32_t> place_;  ///< contact k: k; bridge k: -2 - k; neither: -1
};

/// How far beyond touching two grains can act on each other.
struct AttractionReach {
  double formation_gap = 0;  ///< at the reference radius: a bridge may form within it [m]
  double rupture_gap = 0;    ///< at the reference radius: a living bridge acts within it [m]
  double reference_radius = 1;
};

/// Sorts the grains in space (cells of the largest interaction plus skin, x fastest) and lists all pairs whose gap is
/// below reach + skin. Contacts and bridges keep their memory; it is turned where a pair's order changes.
/// Returns the new place of every grain by its old one, for those who also hold indices.
std::vector<std::int32_t> rebuild(Particles& particles, Interactions& acting, Candidates& candidates,
                                  const AttractionReach& reach, double skin);

/// How far every grain may move before the acting pairs are chosen anew, and from where. Where all is slow the lists
/// are tight; a grain near a fast one may be hit and has as much leeway as that.
struct Leeway {
  std::vector<Vec3> from;
  std::vector<double> distance;  ///< [m]
  std::vector<double> own;       ///< what each grain by itself would be given [m]
};

/// Sets it to what each grain or its fastest candidate moves in `duration`, between the bounds [m].
void set_leeway(const Particles& particles, const Candidates& candidates, double duration, double least, double most,
                Leeway& leeway);

/// The deepest overlap of two grains over the smaller radius, and one of them.
struct Deepest {
  double overlap = 0;
  std::int32_t grain = -1;
};

/// Lists that `select_interactions` fills and uses up, kept so that nothing is allocated in a steady scene.
struct Scratch {
  Choice choice;
  Bridges bridges;
  std::vector<double> alive;  ///< by chosen contact: its bridge
};

/// Chooses from the candidates the pairs that act or may act while no grain moves beyond its leeway: contacts those
/// that may touch, bridges the rest.
Deepest select_interactions(const Particles& particles, Candidates& candidates, Interactions& acting, Scratch& scratch,
                            const AttractionReach& reach, const Leeway& leeway);

}  // namespace pastefit
