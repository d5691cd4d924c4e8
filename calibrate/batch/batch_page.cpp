#include "calibrate/batch/batch_page.h"

#include <cctype>
#include <map>

#include "calibrate/base/text.h"
#include "calibrate/report/report_page.h"

namespace pastefit {

namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --page: #fbfbf9; --text: #1c2126; --soft: #59636e; --rule: #d9dcdf;
  --good: #00694d; --bad: #a63c00; --open: #6d5600; --laboratory: #c14d00; --simulation: #0068ad; }
@media (prefers-color-scheme: dark) { :root { --page: #14181c; --text: #e4e8eb; --soft: #a2adb7; --rule: #343c44;
  --good: #58d3ad; --bad: #ff9e66; --open: #e7cd6b; --laboratory: #ff9a4d; --simulation: #5cb8f5; } }
body { font: 1rem/1.45 system-ui, sans-serif; background: var(--page); color: var(--text); margin: 1.5rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.94rem; }
th, td { text-align: left; vertical-align: top; padding: 0.4rem 0.75rem 0.4rem 0; border-bottom: 1px solid var(--rule); }
thead th { color: var(--soft); font-weight: 500; font-size: 0.85rem; vertical-align: bottom; }
td.reasons { min-width: 18rem; max-width: 30rem; }
td.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
a { color: var(--simulation); }
.met .verdict { color: var(--good); } .open .verdict { color: var(--open); } .bad .verdict { color: var(--bad); }
.measured { color: var(--laboratory); } .simulated { color: var(--simulation); } .soft { color: var(--soft); }
)";

/// A folder's name as part of a link.
std::string in_link(const std::string& name) {
  std::string out;
  for (const char letter : name) {
    const auto byte = static_cast<unsigned char>(letter);
    out += std::isalnum(byte) || letter == '-' || letter == '_' || letter == '.' ? std::string(1, letter)
                                                                                 : format("%%%02X", byte);
  }
  return out;
}

std::string number(std::optional<double> value, const char* kind = "") {
  return "<td class=\"number " + std::string(kind) + "\">" + (value ? plain(*value, 4) : "") + "</td>";
}

std::string head(const std::string& text) {
  return "<th>" + xml_text(text) + "</th>";
}

struct Names {
  std::vector<std::string> laboratory, readings, parameters;
};

std::string head_of(const Names& names) {
  std::string out = "<thead><tr>" + head("study") + head("verdict") + head("reasons") +
                    head("largest error, tolerances") + head("sheared share");
  for (const auto& name : names.readings) out += head(name + " measured") + head("simulated") + head("deviation");
  for (const auto& name : names.parameters) out += head(name) + head("95 % interval");
  for (const auto& name : names.laboratory) out += head(name);
  return out + head("simulations") + head("core s") + head("seed") + "</tr></thead>\n";
}

std::string interval(const BatchRow::Fitted& one) {
  if (!one.lower && !one.upper) return "<td></td>";
  if (one.lower && one.upper)
    return "<td class=\"number soft\">" + interval_in_words(*one.lower, *one.upper, one.at_bounds, 3) + "</td>";
  const auto end = [](std::optional<double> value) { return value ? plain(*value, 3) : std::string("?"); };
  return "<td class=\"number soft\">" + end(one.lower) + " to " + end(one.upper) + "</td>";
}

std::string row_in_html(const BatchRow& row, const Names& names) {
  const bool met = row.verdict == "confirmed";
  std::string out = std::string("<tr class=\"") + (!met ? "bad" : row.reasons.empty() ? "met" : "open") + "\">";
  const std::string name = xml_text(one_line(row.name)), title = xml_text(one_line(row.title));
  const bool page = row.verdict != "pending";
  out += "<td>" + (page ? "<a href=\"" + in_link(row.name) + "/" + kPage + "\">" + name + "</a>" : name) +
         "<br><span class=\"soft\">" + title + "</span></td>";
  out += "<td class=\"verdict\">" + xml_text(row.verdict) + (met && !row.reasons.empty() ? ", with reservations" : "") +
         "</td><td class=\"reasons\">" + xml_text(one_line(row.reasons)) + "</td>";
  out += number(row.error) + number(row.sheared_share);
  for (const auto& reading : names.readings) {
    const auto* one = find_named(row.readings, reading);
    out += one ? number(one->measured, "measured") + number(one->simulated, "simulated") +
                     number(one->simulated - one->measured)
               : "<td></td><td></td><td></td>";
  }
  for (const auto& parameter : names.parameters) {
    const auto* one = find_named(row.parameters, parameter);
    out += one ? number(one->value) + interval(*one) : "<td></td><td></td>";
  }
  for (const auto& variable : names.laboratory) {
    const auto* one = find_named(row.laboratory, variable);
    out += number(one ? one->value : std::nullopt);
  }
  return out + number(row.simulations) + number(row.core_s) + number(static_cast<double>(row.seed)) + "</tr>\n";
}

/// "20 studies: 2 unconfirmed, 18 confirmed."
std::string count_of(const std::vector<BatchRow>& rows) {
  std::string out = format("%zu %s", rows.size(), rows.size() == 1 ? "study" : "studies");
  std::map<std::string, int> counts;
  for (const BatchRow& row : rows) ++counts[row.verdict];
  const char* before = ": ";
  for (const auto& [verdict, count] : counts) {
    out += before + format("%d ", count) + verdict;
    before = ", ";
  }
  return out + ".";
}

}  // namespace

std::string batch_page(const std::vector<BatchRow>& rows) {
  const Names names{names_in(rows, &BatchRow::laboratory), names_in(rows, &BatchRow::readings),
                    names_in(rows, &BatchRow::parameters)};
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\"><title>pastefit: batch</title>\n<style>" +
      std::string(kStyle) + "</style></head>\n<body><h1>Batch</h1>\n<p>" + xml_text(count_of(rows)) +
      " Those that did not meet the laboratory stand on top. Units are in the names of the columns.</p>\n"
      "<div class=\"wide\"><table>" +
      head_of(names) + "<tbody>\n";
  for (const BatchRow& row : worst_first(rows)) out += row_in_html(row, names);
  return out + "</tbody></table></div></body></html>\n";
}

}  // namespace pastefit
