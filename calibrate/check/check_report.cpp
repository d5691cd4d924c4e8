#include <algorithm>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/check/check.h"

namespace pastefit {

namespace {

using nlohmann::ordered_json;

auto count_of(const std::vector<CheckedFile>& checked, CheckVerdict verdict) {
  return std::ranges::count_if(checked, [&](const auto& one) { return one.check.verdict == verdict; });
}

/// Row of the table; after a long name the numbers are on the next line.
std::string table_row(const CheckedReading& reading) {
  const std::string below = reading.name.size() > 34 ? "\n" + std::string(36, ' ') : "";
  const std::string band = reading.band > 0 ? format("%.3g", reading.band) : "none";
  return format("%s %-34s%s %10.5g %10.5g %+10.3g %8s\n", reading.agrees() ? " " : "x", reading.name.c_str(),
                below.c_str(), reading.expected, reading.got, reading.got - reading.expected, band.c_str());
}

}  // namespace

std::string text_of(const CheckedFile& checked) {
  const auto& check = checked.check;
  std::string out = checked.file.string() + ": " + one_line(check.card) + "\n";
  if (!check.readings.empty())
    out += format("  %-34s %10s %10s %10s %8s\n", "reading", "card", "now", "difference", "band");
  for (const auto& reading : check.readings) out += table_row(reading);
  if (!std::ranges::all_of(check.readings, &CheckedReading::agrees)) out += "  x: outside the band\n";
  if (check.simulations > 0)
    out += format("  %d simulations; bits: %s. If the card is still valid, the probability of a false alarm is %g.\n",
                  check.simulations, std::string(name_of(check.bits)).c_str(), check.false_alarm);
  out += "  " + std::string(name_of(check.verdict));
  return wrapped(out + lines_of(check.reason.empty() ? "" : ": " + check.reason) + "\n");
}

ordered_json to_json(const std::vector<CheckedFile>& checked) {
  ordered_json out{{"agree", count_of(checked, CheckVerdict::agrees)},
                   {"disagree", count_of(checked, CheckVerdict::disagrees)},
                   {"not_checked", count_of(checked, CheckVerdict::not_checked)},
                   {"cards", ordered_json::array()}};
  for (const auto& [file, check, seconds] : checked) {
    ordered_json readings = ordered_json::object();
    for (const auto& reading : check.readings)
      readings[reading.name] = {{"expected", reading.expected}, {"expected_runs", reading.expected_count},
                                {"got", reading.got},           {"got_runs", reading.got_count},
                                {"band", reading.band},         {"agrees", reading.agrees()}};
    out["cards"].push_back({{"file", file.string()},
                            {"title", check.card},
                            {"verdict", name_of(check.verdict)},
                            {"bits", name_of(check.bits)},
                            {"same_program", check.same_program},
                            {"reason", check.reason},
                            {"false_alarm", check.false_alarm},
                            {"simulations", check.simulations},
                            {"seconds", seconds},
                            {"readings", std::move(readings)}});
  }
  return out;
}

std::string junit_of(const std::vector<CheckedFile>& checked) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  double seconds = 0;
  for (const CheckedFile& one : checked) seconds += one.seconds;
  out += format("<testsuite name=\"pastefit check\" time=\"%.3f\" tests=\"%zu\" failures=\"%ld\" errors=\"%ld\">\n",
                seconds, checked.size(), static_cast<long>(count_of(checked, CheckVerdict::disagrees)),
                static_cast<long>(count_of(checked, CheckVerdict::not_checked)));
  for (const auto& one : checked) {
    out += "  <testcase classname=\"pastefit.check\" name=\"" + xml_text(one.file.string()) +
           format("\" time=\"%.3f\">\n", one.seconds);
    const auto tag = one.check.verdict == CheckVerdict::disagrees     ? "failure"
                     : one.check.verdict == CheckVerdict::not_checked ? "error"
                                                                      : "";
    if (*tag) out += "    <" + std::string(tag) + " message=\"" + xml_text(one.check.reason) + "\"/>\n";
    out += "    <system-out>" + xml_text(text_of(one)) + "</system-out>\n  </testcase>\n";
  }
  return out + "</testsuite>\n";
}

}  // namespace pastefit
