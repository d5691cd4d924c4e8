#include <catch2/catch.hpp>

#include "calibrate/base/text.h"

using namespace pastefit;

TEST_CASE("base64 is that of RFC 4648, whatever is left over at the end") {
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64("\xFF\xFE") == "//4=");
}
