#pragma once

#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/laboratory/names.h"

namespace pastefit_lammps {

/// The words of a command, "NAME VALUE NAME VALUE ...", read by the descriptions that cards are read by
/// (calibrate/laboratory/names.h). A name inside of an object has its path: bridge.c_n. Numbers that have a default may
/// be left out; so may an object as a whole.
class Words {
 public:
  explicit Words(const std::vector<std::string>& words) {
    if (words.size() % 2 != 0) fault("'" + words.back() + "' has no value");
    for (std::size_t i = 0; i + 1 < words.size(); i += 2)
      if (!values_.emplace(words[i], words[i + 1]).second) fault("'" + words[i] + "' is named twice");
  }

  void number(const pastefit::Key& name, double& to, const pastefit::Range& range, pastefit::Need need) {
    const std::optional<std::string> text = take(name, need);
    if (!text) return;
    char* end = nullptr;
    to = std::strtod(text->c_str(), &end);
    const bool within = to >= range.smallest && to <= range.largest && !(range.open && to == range.smallest);
    if (text->empty() || *end || !within) fault("'" + place(name) + " " + *text + "' is not in its range");
  }
  void number(const pastefit::Key& name, double& to, const pastefit::Range& range, pastefit::Default<double>) {
    number(name, to, range, pastefit::Need::optional);
  }
  void nullable_number(const pastefit::Key& name, std::optional<double>& to, const pastefit::Range& range,
                       pastefit::Need) {
    if (values_.count(place(name)) > 0) number(name, to.emplace(), range, pastefit::Need::required);
  }
  template <class T, std::size_t N>
  void choice(const pastefit::Key& name, T& to, const std::array<pastefit::Named<T>, N>& words, pastefit::Need need) {
    const std::optional<std::string> text = take(name, need);
    if (!text) return;
    std::string list;
    for (const pastefit::Named<T>& word : words) {
      if (word.name == *text) {
        to = word.value;
        return;
      }
      list += " " + std::string(word.name);
    }
    fault("'" + place(name) + " " + *text + "': one of" + list);
  }
  template <class T, std::size_t N>
  void choice(const pastefit::Key& name, T& to, const std::array<pastefit::Named<T>, N>& words, pastefit::Default<T>) {
    choice(name, to, words, pastefit::Need::optional);
  }
  void shared(std::string_view) {}  // schemas alone give objects names
  template <class Body>
  void object(const pastefit::Key& name, pastefit::Need, const Body& body) {
    const std::string before = path_, own = place(name) + ".";
    const auto first = values_.lower_bound(own);
    if (first == values_.end() || first->first.compare(0, own.size(), own) != 0) return;
    path_ = own;
    body(*this);
    path_ = before;
  }

  void fault(const std::string& text) { faults_ += "\n  " + text; }
  /// What is wrong, a line for each fault; empty: nothing. To be asked for when all is read.
  std::string faults() {
    for (const auto& one : values_) fault("'" + one.first + "' is not known here");
    values_.clear();
    return faults_;
  }

 private:
  std::string place(std::string_view name) const { return path_ + std::string(name); }
  std::optional<std::string> take(std::string_view name, pastefit::Need need) {
    const auto found = values_.find(place(name));
    if (found == values_.end()) {
      if (need == pastefit::Need::required) fault("'" + place(name) + "' is missing");
      return std::nullopt;
    }
    std::string text = found->second;
    values_.erase(found);
    return text;
  }

  std::map<std::string, std::string> values_;
  std::string path_, faults_;
};

}  // namespace pastefit_lammps
