#include "core/world/neighbours.h"

#include <algorithm>
#include <cmath>

namespace pastefit {

namespace {

/// Cells of a box around the grains. Grains outside the box (none in a healthy run) are counted in its outermost cells.
struct Grid {
  Vec3 origin;
  double inverse_size = 0;
  std::int32_t nx = 1, ny = 1, nz = 1;

  std::int32_t cells() const { return nx * ny * nz; }
  std::int32_t along(double offset, std::int32_t n) const {
    const double k = offset * inverse_size;
    return k > 0 ? std::min(static_cast<std::int32_t>(std::min(k, 1e9)), n - 1) : 0;
  }
  std::int32_t cell(const Vec3& p) const {
    return (along(p.z - origin.z, nz) * ny + along(p.y - origin.y, ny)) * nx + along(p.x - origin.x, nx);
  }
};

Grid make_grid(const Particles& particles, double size) {
  Vec3 low = particles.motion[0].position, high = low;
  for (std::int32_t i = 0; i < particles.count(); ++i) {
    const Vec3& p = particles.motion[i].position;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  // A handful of stray grains must not make the grid huge: larger cells are slower, never wrong.
  const double most_cells = 64.0 * particles.count() + 1000;
  const Vec3 span = high - low;
  while ((span.x / size + 1) * (span.y / size + 1) * (span.z / size + 1) > most_cells) size *= 1.3;
  Grid grid;
  grid.origin = low;
  grid.inverse_size = 1 / size;
  grid.nx = static_cast<std::int32_t>(span.x / size) + 1;
  grid.ny = static_cast<std::int32_t>(span.y / size) + 1;
  grid.nz = static_cast<std::int32_t>(span.z / size) + 1;
  return grid;
}

/// Old index of the grain at each new place, by cell, and the first place of every cell.
void sort_by_cell(const Particles& particles, const Grid& grid, std::vector<std::int32_t>& order,
                  std::vector<std::int32_t>& first) {
  const std::int32_t n = particles.count();
  std::vector<std::int32_t> cell(n);
  first.assign(grid.cells() + 1, 0);
  for (std::int32_t i = 0; i < n; ++i) {
    cell[i] = grid.cell(particles.motion[i].position);
    ++first[cell[i] + 1];
  }
  for (std::int32_t c = 0; c < grid.cells(); ++c) first[c + 1] += first[c];
  std::vector<std::int32_t> next(first.begin(), first.end() - 1);
  order.resize(n);
  for (std::int32_t i = 0; i < n; ++i) order[next[cell[i]]++] = i;
}

double largest_radius(const Particles& particles) {
  double largest = 0;
  for (std::int32_t i = 0; i < particles.count(); ++i) largest = std::max(largest, particles.motion[i].radius);
  return largest;
}

/// 2 R*/R_ref of two grains.
double size_scale(double r1, double r2, double reference_radius) {
  return 2 * r1 * r2 / ((r1 + r2) * reference_radius);
}

/// Candidates with a memory, grouped by the lower index of their grains: found again after the grains have been sorted.
class Remembered {
 public:
  Remembered(const Candidates& old, const std::vector<std::int32_t>& new_place, std::int32_t grains)
      : first_(grains + 1, 0) {
    const auto lower = [&](std::size_t c) { return std::min(new_place[old.i[c]], new_place[old.j[c]]); };
    const auto upper = [&](std::size_t c) { return std::max(new_place[old.i[c]], new_place[old.j[c]]); };
    const auto known = [&](std::size_t c) { return old.is_contact(c) || old.is_bridge(c); };
    for (std::size_t c = 0; c < old.size(); ++c)
      if (known(c)) ++first_[lower(c) + 1];
    for (std::int32_t i = 0; i < grains; ++i) first_[i + 1] += first_[i];
    std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
    upper_.resize(first_.back());
    place_.resize(first_.back());
    for (std::size_t c = 0; c < old.size(); ++c) {
      if (!known(c)) continue;
      const std::int32_t p = next[lower(c)]++;
      upper_[p] = upper(c);
      place_[p] = old.place(c);
    }
  }

  std::int32_t find(std::int32_t i, std::int32_t j) const {
    for (std::int32_t p = first_[i]; p < first_[i + 1]; ++p)
      if (upper_[p] == j) return place_[p];
    return Candidates::kNone;
  }

 private:
  std::vector<std::int32_t> first_, upper_, place_;
};

/// Gives the bridges the new indices.
void renumber(Bridges& bridges, const std::vector<std::int32_t>& new_place) {
  for (std::int32_t k = 0; k < bridges.count; ++k) {
    const std::int32_t a = new_place[bridges.i[k]], b = new_place[bridges.j[k]];
    bridges.i[k] = std::min(a, b);
    bridges.j[k] = std::max(a, b);
  }
}

/// Gives the contacts the new indices; a pair whose order changes is seen from the other side: its vectors change sign.
void renumber(Contacts& contacts, const std::vector<std::int32_t>& new_place) {
  for (std::int32_t k = 0; k < contacts.count; ++k) {
    const std::int32_t a = new_place[contacts.i[k]], b = new_place[contacts.j[k]];
    contacts.i[k] = std::min(a, b);
    contacts.j[k] = std::max(a, b);
    if (a < b) continue;
    for (int c = 0; c < 3; ++c) {
      contacts.slip[c][k] = -contacts.slip[c][k];
      contacts.roll[c][k] = -contacts.roll[c][k];
    }
  }
}

}  // namespace

void Candidates::clear() {
  i.clear();
  j.clear();
  place_.clear();
}

void Candidates::add(std::int32_t a, std::int32_t b, std::int32_t place) {
  i.push_back(a);
  j.push_back(b);
  place_.push_back(place);
}

std::vector<std::int32_t> rebuild(Particles& particles, Interactions& acting, Candidates& candidates,
                                  const AttractionReach& reach, double skin) {
  const std::int32_t n = particles.count();
  const double largest = largest_radius(particles);
  const double farthest = std::max(reach.formation_gap, reach.rupture_gap) / reach.reference_radius;
  const Grid grid = make_grid(particles, 2 * largest + farthest * largest + skin);

  std::vector<std::int32_t> order, first;
  sort_by_cell(particles, grid, order, first);
  reorder(particles, order);
  std::vector<std::int32_t> new_place(n);
  for (std::int32_t k = 0; k < n; ++k) new_place[order[k]] = k;
  const Remembered remembered(candidates, new_place, n);
  renumber(acting.contacts, new_place);
  renumber(acting.bridges, new_place);

  candidates.clear();
  const auto look = [&](std::int32_t i, std::int32_t begin, std::int32_t end) {
    const Motion& a = particles.motion[i];
    for (std::int32_t j = begin; j < end; ++j) {
      const Motion& b = particles.motion[j];
      const Vec3 between = b.position - a.position;
      const double range = a.radius + b.radius + farthest * 2 * a.radius * b.radius / (a.radius + b.radius) + skin;
      if (dot(between, between) >= range * range) continue;
      candidates.add(i, j, remembered.find(i, j));
    }
  };
  // Half of the neighbourhood: the rest of this cell's row, and the three cells above it in each later row. Cells along
  // x are neighbours in memory, so a row of three is one range.
  for (std::int32_t z = 0; z < grid.nz; ++z)
    for (std::int32_t y = 0; y < grid.ny; ++y)
      for (std::int32_t x = 0; x < grid.nx; ++x) {
        const std::int32_t cell = (z * grid.ny + y) * grid.nx + x;
        const std::int32_t left = std::max(x - 1, 0), right = std::min(x + 1, grid.nx - 1);
        for (std::int32_t i = first[cell]; i < first[cell + 1]; ++i) {
          look(i, i + 1, first[cell - x + right + 1]);
          const auto look_row = [&](std::int32_t row_y, std::int32_t row_z) {
            if (row_y < 0 || row_y >= grid.ny || row_z >= grid.nz) return;
            const std::int32_t row = (row_z * grid.ny + row_y) * grid.nx;
            look(i, first[row + left], first[row + right + 1]);
          };
          look_row(y + 1, z);
          for (std::int32_t dy = -1; dy <= 1; ++dy) look_row(y + dy, z + 1);
        }
      }
  return new_place;
}

void set_leeway(const Particles& particles, const Candidates& candidates, double duration, double least, double most,
                Leeway& leeway) {
  const std::int32_t n = particles.count();
  leeway.from.resize(n);
  std::vector<double>& own = leeway.own;
  own.resize(n);
  for (std::int32_t i = 0; i < n; ++i) {
    leeway.from[i] = particles.motion[i].position;
    own[i] = std::clamp(norm(particles.motion[i].velocity) * duration, least, most);
  }
  leeway.distance = own;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const std::int32_t i = candidates.i[c], j = candidates.j[c];
    leeway.distance[i] = std::max(leeway.distance[i], own[j]);
    leeway.distance[j] = std::max(leeway.distance[j], own[i]);
  }
}

Deepest select_interactions(const Particles& particles, Candidates& candidates, Interactions& acting, Scratch& scratch,
                            const AttractionReach& reach, const Leeway& leeway) {
  const auto n = static_cast<std::int32_t>(candidates.size());
  Choice& choice = scratch.choice;
  Bridges& bridges = scratch.bridges;
  choice.clear();
  bridges.clear();
  scratch.alive.clear();
  const double forming = std::min(reach.formation_gap, reach.rupture_gap);
  Deepest deepest;
  for (std::int32_t c = 0; c < n; ++c) {
    const std::int32_t i = candidates.i[c], j = candidates.j[c];
    const Motion &a = particles.motion[i], &b = particles.motion[j];
    const Vec3 between = b.position - a.position;
    const double square = dot(between, between), touch = a.radius + b.radius;
    const double margin = leeway.distance[i] + leeway.distance[j];
    const bool contact = candidates.is_contact(c), bridge = candidates.is_bridge(c);
    const std::int32_t k = candidates.index(c);
    const double alive = contact ? acting.contacts.bridge[k] : bridge ? acting.bridges.bridge[k] : 0.0;
    const double scale = size_scale(a.radius, b.radius, reach.reference_radius);
    const double range = touch + (alive > 0 ? reach.rupture_gap : forming) * scale + margin;
    if (square >= range * range) {
      candidates.set_none(c);
      continue;
    }
    if (square >= (touch + margin) * (touch + margin)) {
      candidates.set_bridge(c, bridges.count);
      bridges.append(i, j, scale, alive);
      continue;
    }
    if (square < touch * touch) {
      const double overlap = (touch - std::sqrt(square)) / std::min(a.radius, b.radius);
      if (overlap > deepest.overlap) deepest = {overlap, i};
    }
    candidates.set_contact(c, choice.count);
    choice.add(i, j, contact ? k : Choice::kNew);
    scratch.alive.push_back(contact ? -1.0 : alive);
  }
  Contacts& contacts = acting.contacts;
  contacts.rearrange(choice, particles.count());
  for (std::int32_t k = 0; k < contacts.count; ++k) {
    if (scratch.alive[k] < 0) continue;
    const std::int32_t i = contacts.i[k], j = contacts.j[k];
    const double ra = particles.motion[i].radius, rb = particles.motion[j].radius;
    const double ma = particles.spin[i].inverse_mass, mb = particles.spin[j].inverse_mass;
    contacts.describe(k, ra * rb / (ra + rb), 1 / (ma + mb), size_scale(ra, rb, reach.reference_radius));
    contacts.bridge[k] = scratch.alive[k];
  }
  bridges.pad(particles.count());
  std::swap(acting.bridges, bridges);
  return deepest;
}

}  // namespace pastefit
