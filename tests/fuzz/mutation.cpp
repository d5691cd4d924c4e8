#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <set>
#include <string_view>

namespace pastefit::fuzz {

namespace {

/// What a number or a word is replaced with: beyond bounds, of another kind, or nothing at all.
constexpr std::array<std::string_view, 32> kOdd{"0",          "-0.0",
                                                "-1",         "1e-300",
                                                "5e-324",     "1e308",
                                                "1e999",      "-1e999",
                                                "2147483648", "4294967296",
                                                "1e15",       "0.3",
                                                "7",          "1.5",
                                                "null",       "true",
                                                "false",      "[]",
                                                "{}",         "[[]]",
                                                "\"\"",       "\"nan\"",
                                                "NaN",        "[1, 2]",
                                                "\"x\"",      "18446744073709551616",
                                                "1e-152",     "1e-160",
                                                "-1e200",     "1e16",
                                                "1e-320",     "0.30000000000000004"};

/// Where a number or a string begins and ends.
struct Token {
  std::size_t begin, end;
};

std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> tokens;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t begin = i;
    if (text[i] == '"') {
      for (++i; i < text.size() && text[i] != '"'; ++i)
        if (text[i] == '\\') ++i;
      tokens.push_back({begin, std::min(i + 1, text.size())});
    } else if (text[i] == '-' || std::isdigit(static_cast<unsigned char>(text[i]))) {
      while (i + 1 < text.size() && std::string_view("0123456789.eE+-").find(text[i + 1]) != std::string_view::npos)
        ++i;
      tokens.push_back({begin, i + 1});
    }
  }
  return tokens;
}

/// Numbers from a stream, one after the other.
class Draw {
 public:
  explicit Draw(const RandomStream& stream) : stream_(stream) {}
  /// Below `count`, which is at least 1.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(stream_.bits(number_++) % count); }

 private:
  RandomStream stream_;
  std::uint64_t number_ = 0;
};

void replace_token(std::string& text, const std::vector<std::string>& words, Draw& draw) {
  const auto tokens = tokens_of(text);
  if (tokens.empty()) return;
  const Token token = tokens[draw.below(tokens.size())];
  const bool by_word = !words.empty() && draw.below(2) == 0;
  text.replace(token.begin, token.end - token.begin,
               by_word ? std::string_view(words[draw.below(words.size())]) : kOdd[draw.below(kOdd.size())]);
}

void change(std::string& text, const std::vector<std::string>& texts, const std::vector<std::string>& words,
            Draw& draw) {
  if (text.empty()) return;
  const std::size_t place = draw.below(text.size());
  const std::size_t length = std::min(text.size() - place, 1 + draw.below(1 + draw.below(200)));
  switch (draw.below(10)) {
    case 0:
      text[place] = static_cast<char>(text[place] ^ (1 << draw.below(8)));
      return;
    case 1:
      text.erase(place, length);
      return;
    case 2:
      text.insert(draw.below(text.size()), text.substr(place, length));
      return;
    case 3: {
      const std::string& other = texts[draw.below(texts.size())];
      text.insert(place, other.substr(draw.below(other.size() + 1), length));
      return;
    }
    case 4:
      if (draw.below(4) == 0) text.resize(place);
      return;
    default:
      replace_token(text, words, draw);
  }
}

}  // namespace

std::vector<std::string> describe(const std::vector<std::string>& texts) {
  std::set<std::string> words;
  for (const std::string& text : texts)
    for (const Token& token : tokens_of(text))
      if (text[token.begin] == '"' && token.end - token.begin <= 42)
        words.insert(text.substr(token.begin, token.end - token.begin));
  return {words.begin(), words.end()};
}

std::string mutated(std::string text, const std::vector<std::string>& texts, const std::vector<std::string>& words,
                    const RandomStream& random) {
  Draw draw(random);
  for (std::size_t left = 1 + draw.below(6); left > 0; --left) change(text, texts, words, draw);
  return text;
}

}  // namespace pastefit::fuzz
