#include "calibrate/search/space_filling.h"

#include <boost/random/sobol.hpp>
#include <cmath>
#include <stdexcept>

namespace pastefit {

std::uint64_t hash_of(std::uint64_t seed, std::uint64_t counter) {
  std::uint64_t z = seed * 0xd1342543de82ef95ULL + (counter + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

std::vector<UnitPoint> screening_points(int dimension, int count, std::uint64_t seed) {
  if (dimension < 1 || count < 0) throw std::logic_error("screening_points: needs dimension >= 1 and count >= 0");
  UnitPoint shift = UnitPoint::Zero(dimension);
  if (seed != 0) {
    for (int k = 0; k < dimension; ++k) {
      shift[k] = std::ldexp(static_cast<double>(hash_of(seed, static_cast<std::uint64_t>(k)) >> 11), -53);
    }
  }
  // The engine leaves out the corner 0 by itself. It yields 64-bit integers; their top 53 bits make the coordinate
  // exact and the same everywhere.
  boost::random::sobol engine(static_cast<std::size_t>(dimension));
  std::vector<UnitPoint> points(static_cast<std::size_t>(count), UnitPoint(dimension));
  for (UnitPoint& point : points) {
    for (int k = 0; k < dimension; ++k) {
      const double moved = std::ldexp(static_cast<double>(engine() >> 11), -53) + shift[k];
      point[k] = moved >= 1 ? moved - 1 : moved;
    }
  }
  return points;
}

}  // namespace pastefit
