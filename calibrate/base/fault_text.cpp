#include "calibrate/base/fault_text.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

namespace pastefit {
namespace {

using nlohmann::json;

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

Faults in_file(Faults faults, const std::filesystem::path& file) {
  if (file.empty()) return faults;
  for (Fault& fault : faults) fault.where = file.string() + (fault.where.empty() ? "" : ": " + fault.where);
  return faults;
}

std::string message_of(const Faults& faults) {
  std::string message;
  for (const Fault& fault : faults) {
    if (!message.empty()) message += '\n';
    message += fault.where + (fault.where.empty() ? "" : ": ") + fault.what;
    if (!fault.remedy.empty()) message += "; " + fault.remedy;
  }
  return message;
}

std::string shown(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", number);
  return text.data();
}

std::optional<std::string> nearest(std::string_view word, const std::set<std::string, std::less<>>& candidates) {
  constexpr std::size_t longest = 200;  // a longer word is no slip of the pen, and the distance is quadratic
  if (word.size() > longest) return std::nullopt;
  const std::string* best = nullptr;
  std::size_t best_distance = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (!best || distance < best_distance) {
      best = &candidate;
      best_distance = distance;
    }
  }
  if (!best || best_distance > std::max<std::size_t>(2, std::max(word.size(), best->size()) / 2)) return std::nullopt;
  return *best;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  const std::string cut = text.size() > longest ? std::string(text.substr(0, longest)) + "..." : std::string(text);
  return json(cut).dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string printable(std::string_view key) {
  const std::string text = in_quotes(key);
  return text.substr(1, text.size() - 2);
}

std::string joined(const std::string& place, std::string_view key) {
  return place.empty() ? std::string(key) : place + "." + std::string(key);
}

}  // namespace pastefit
