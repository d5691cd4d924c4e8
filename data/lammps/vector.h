#pragma once

#include <cmath>

namespace pastefit_lammps {

struct Vector {
  double x = 0, y = 0, z = 0;
};

inline Vector vector(const double* v) {
  return {v[0], v[1], v[2]};
}
inline Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector operator*(double k, const Vector& a) {
  return {k * a.x, k * a.y, k * a.z};
}
inline double dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double norm(const Vector& a) {
  return std::sqrt(dot(a, a));
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline void add(double* to, const Vector& a) {
  to[0] += a.x;
  to[1] += a.y;
  to[2] += a.z;
}

}  // namespace pastefit_lammps
