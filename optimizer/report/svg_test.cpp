// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/svg.h"

#include <gtest/gtest.h>

#include "report/palette.h"
#include "report/xml_for_tests.h"

namespace bondlab {
namespace {

TEST(XmlEscape, KeepsWordsAndDisarmsMarkup) {
  EXPECT_EQ(xml_escape("a < b & \"c\" > 'd'"), "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  EXPECT_EQ(xml_escape("50 µm, σ ≤ 9\n\tok 𝛔"), "50 µm, σ ≤ 9\n\tok 𝛔");
}

TEST(XmlEscape, ReplacesWhatXmlForbids) {
  const std::string bad = "\uFFFD";
  EXPECT_EQ(xml_escape(std::string("a\0b\x1b[31m", 8)), "a" + bad + "b" + bad + "[31m");
  EXPECT_EQ(xml_escape("\xff"), bad);
  EXPECT_EQ(xml_escape("\xc3"), bad);                                // cut off
  EXPECT_EQ(xml_escape("\xc0\xbc"), bad + bad);                      // '<' in two bytes
  EXPECT_EQ(xml_escape("\xed\xa0\x80"), bad + bad + bad);            // half of a surrogate pair
  EXPECT_EQ(xml_escape("\xef\xbf\xbe"), bad + bad + bad);            // U+FFFE
  EXPECT_EQ(xml_escape("\xf4\x90\x80\x80"), bad + bad + bad + bad);  // beyond U+10FFFF
}

TEST(Compact, WritesNoMoreThanNeeded) {
  EXPECT_EQ(compact(12.5), "12.5");
  EXPECT_EQ(compact(3), "3");
  EXPECT_EQ(compact(-0.001), "0");
  EXPECT_EQ(compact(-0.126), "-0.13");
  EXPECT_EQ(compact(100), "100");
  EXPECT_EQ(compact(1.0 / 0.0), "0");
}

TEST(SvgWriter, IsWellFormedWithHostileWords) {
  const std::string hostile = "</text></svg><script>alert(1)</script> \" ' & ]]> \x01";
  SvgWriter svg(100, 50, hostile, hostile);
  svg.open_group("fill=\"none\"");
  svg.circle(1, 2, 3);
  svg.line(0, 0, 1, 1, "stroke=\"#000000\"");
  svg.rectangle(0, 0, 1, 1, "fill=\"#000000\"");
  svg.path("M0 0h1", "stroke=\"#000000\"");
  svg.close_group();
  svg.text(1, 1, hostile, "x-y=\"1\"");
  const xml::Document document = xml::parse(svg.finish());
  EXPECT_EQ(document.error, "");
  EXPECT_EQ(document.count("script"), 0u);
  EXPECT_EQ(document.count("circle"), 1u);
  ASSERT_EQ(document.count("text"), 1u);
  EXPECT_EQ(document.elements.back().text,
            "</text></svg><script>alert(1)</script> \" ' & ]]> \uFFFD");
}

TEST(Palette, LightValuesAreAllDifferent) {
  for (const Colour &a : palette())
    for (const Colour &b : palette()) {
      if (&a == &b) continue;
      EXPECT_STRNE(a.light, b.light) << a.role << " and " << b.role;
      EXPECT_STRNE(a.role, b.role);
    }
}

TEST(Palette, ReplacesColoursInMarkupOnly) {
  const std::string svg =
      std::string("<g fill=\"") + light("ink") + "\"><text>" + light("ink") + "</text></g>";
  EXPECT_EQ(with_css_variables(svg),
            std::string("<g fill=\"var(--ink)\"><text>") + light("ink") + "</text></g>");
}

}  // namespace
}  // namespace bondlab
