#include "calibrate/report/page.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "calibrate/base/text.h"
#include "calibrate/report/page_content.h"

// The page as esbuild leaves it, between two symbols. Bytes of a file in a few lines of assembler: a source made of
// them would be five times as long, and take a second to compile.
asm(R"(
  .section .rodata
  .global pastefit_page_begin, pastefit_page_end
pastefit_page_begin:
  .incbin ")" PASTEFIT_PAGE_FILE R"("
pastefit_page_end:
  .previous
)");
extern "C" const char pastefit_page_begin[], pastefit_page_end[];

namespace pastefit {

namespace {

std::string_view empty_page() {
  return {pastefit_page_begin, static_cast<std::size_t>(pastefit_page_end - pastefit_page_begin)};
}

}  // namespace

std::string page_of(const Findings& findings, const std::string& command) {
  constexpr std::string_view kPlace = "<!--content-->";
  const std::string_view page = empty_page();
  const std::size_t place = page.find(kPlace);
  if (place == std::string_view::npos) throw std::logic_error("the page has no place for its content");
  std::string out(page.substr(0, place));
  out += "<script type=\"application/json\" id=\"content\">" + json_in_html(page_content(findings, command)) +
         "</script>\n";
  for (std::size_t i = 0; i < findings.views.size(); ++i)
    if (const CodedRecording& film = findings.views[i].film; !film.empty())
      out += "<script type=\"text/plain\" id=\"film-" + std::to_string(i) + "\">" + film.grains + "</script>\n";
  out += page.substr(place + kPlace.size());
  return out;
}

}  // namespace pastefit
