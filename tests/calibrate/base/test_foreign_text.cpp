#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"

using namespace pastefit;

TEST_CASE("a foreign text is one line of valid UTF-8 without controls") {
  CHECK(one_line("Beton Nr. 7, Größe ½") == "Beton Nr. 7, Größe ½");
  CHECK(one_line("a\nb\r\x1b[2Jc\a\x7f") == "a b  [2Jc  ");
  CHECK(one_line("\xC2\x9B"
                 "31m\xE2\x80\xA8x\xE2\x80\xAEy") == " 31m x y");  // CSI, line separator, right to left
  CHECK(lines_of("a\n\tb\x1b") == "a\n\tb ");
  const std::string none = "\xEF\xBF\xBD";
  CHECK(one_line("\xff"
                 "a") == none + "a");
  CHECK(one_line("\xE2\x82") == none + none);                        // cut
  CHECK(one_line("\xC0\xAF") == none + none);                        // a slash in two bytes
  CHECK(one_line("\xED\xA0\x80") == none + none + none);             // half of a pair
  CHECK(one_line("\xF4\x90\x80\x80") == none + none + none + none);  // beyond the last one
}

TEST_CASE("a comment of a deck holds nothing that its reader acts on") {
  CHECK(deck_comment("paste\nshell touch x") == "# paste shell touch x\n");
  CHECK(deck_comment("a \"\"\" b & ${c} \\") == "# a ''' b + /{c} /\n");
}

TEST_CASE("a text in XML is no markup") {
  CHECK(xml_text("<a href=\"x\" b='y'>&\n\x1b") == "&lt;a href=&quot;x&quot; b=&apos;y&apos;&gt;&amp;&#10; ");
}

TEST_CASE("JSON is valid whatever bytes it is made of, and keeps its letters") {
  CHECK(json_text({{"a", "Größe"}}) == "{\n  \"a\": \"Größe\"\n}\n");
  CHECK(json_text({{"a", "\xff"}}) == "{\n  \"a\": \"\xEF\xBF\xBD\"\n}\n");
  const std::string turned = json_text({{"a", "\xE2\x80\xAE"}});
  CHECK(lines_of(turned) == turned);
  CHECK(nlohmann::json::parse(turned)["a"] == "\xE2\x80\xAE");
}

TEST_CASE("JSON in HTML has no letter that could end or begin an element, and reads back as it was") {
  const nlohmann::ordered_json value{{"</script><!--", "a & <b> \xE2\x80\xA8 \u00fc"}};
  const std::string text = json_in_html(value);
  CHECK(text.find_first_of("<>&\n") == std::string::npos);
  CHECK(nlohmann::ordered_json::parse(text) == value);
}
