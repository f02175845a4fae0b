#include <catch2/catch.hpp>

#include "runner/report/html.hpp"

using namespace grainsweep;

TEST_CASE("text of users keeps no meaning as markup", "[report]") {
  CHECK(html_text("<script>alert('a' & \"b\")</script>") ==
        "&lt;script&gt;alert(&#39;a&#39; &amp; &quot;b&quot;)&lt;/script&gt;");
  CHECK(html_text("a\x01z\n") == "a\xEF\xBF\xBDz\n");
  CHECK(html_text("φ") == "φ");
}

TEST_CASE("base64 is that of RFC 4648, section 10", "[report]") {
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(data_uri("image/png", "foo") == "data:image/png;base64,Zm9v");
  CHECK(base64(std::string("\xFF\x00\xFE", 3)) == "/wD+");
}

TEST_CASE("reasons have the sign ± on the page", "[report]") {
  CHECK(with_signs("0.33 +- 0.173 d or 1 +- 2") == "0.33 ± 0.173 d or 1 ± 2");
  CHECK(with_signs("a+-b") == "a+-b");
  CHECK(with_signs("").empty());
}

TEST_CASE("no line of a table ends between a value and its error", "[report]") {
  CHECK_THAT(html_table({"t", "t", {{"x"}, {"y"}}, {{"a ± b", "0.5 ± 0.1 d"}}}),
             Catch::Contains("a\u00A0±\u00A0b") && Catch::Contains("0.5\u00A0±\u00A00.1 d"));
}

TEST_CASE("a part of a page is not searched for names of parts", "[report]") {
  CHECK(filled("<{{a}}|{{b}}>", {{"a", "{{b}}"}, {"b", "2"}}) == "<{{b}}|2>");
  CHECK_THROWS_AS(filled("{{missing}}", {}), std::out_of_range);
}

TEST_CASE("a table names its columns and heads each row by its first cell", "[report]") {
  const std::string html =
      html_table({"t", "A \"caption\"", {{"x", "a < b"}, {"y"}}, {{"1", "2"}}});
  CHECK(html.find("<caption>A &quot;caption&quot;</caption>") != std::string::npos);
  CHECK(html.find(R"(<th scope="col" title="a &lt; b">x</th><th scope="col">y</th>)") !=
        std::string::npos);
  CHECK(html.find(R"(<tr><th scope="row">1</th><td>2</td></tr>)") != std::string::npos);
}
