// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/page_style.h"

#include "report/palette.h"

namespace bondlab {

std::string page_style() {
  return palette_css() + R"(*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink);font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
main,header.page,footer{max-width:1140px;margin:0 auto;padding:0 20px}
header.page{padding-top:36px}
.kicker{margin:0;color:var(--quiet);font-size:13px;letter-spacing:.08em;text-transform:uppercase}
h1{margin:4px 0 14px;font-size:28px;line-height:1.2;font-weight:650;overflow-wrap:anywhere}
h2{margin:44px 0 12px;padding-top:14px;border-top:2px solid var(--rule);font-size:20px;font-weight:650}
h3{margin:22px 0 8px;font-size:15px;font-weight:650}
p{margin:8px 0;max-width:78ch;overflow-wrap:anywhere}
.lead{margin:0;font-size:17px;max-width:none}
.verdict{margin:0 0 18px;padding:14px 18px;border-left:5px solid var(--good);background:var(--good-fill);border-radius:3px}
.verdict.bad{border-color:var(--bad);background:var(--bad-fill)}
.verdict.warn{border-color:var(--warn);background:var(--warn-fill)}
.verdict p{max-width:none}
.verdict p+p{margin-top:8px}
.facts{display:flex;flex-wrap:wrap;gap:10px 34px;margin:0 0 8px;padding:0;list-style:none}
.facts dt{color:var(--quiet);font-size:13px}
.facts dd{margin:0;font-size:20px;font-weight:600;font-variant-numeric:tabular-nums}
nav{margin:16px 0 0;font-size:14px}
nav a{margin-right:18px;color:var(--series-1);text-decoration:none;white-space:nowrap}
nav a:hover{text-decoration:underline}
.scroll{overflow-x:auto;margin:10px 0 6px}
table{border-collapse:collapse;width:100%;font-size:14px;font-variant-numeric:tabular-nums}
caption{padding:0 0 6px;text-align:left;color:var(--quiet);font-size:13px}
th,td{padding:6px 16px 6px 0;text-align:left;vertical-align:top;border-bottom:1px solid var(--rule)}
thead th{color:var(--quiet);font-size:13px;font-weight:500;vertical-align:bottom;border-bottom:2px solid var(--rule)}
tbody th{font-weight:600}
td:last-child:not(.n){min-width:17ch}
td,th{overflow-wrap:break-word}
#assumptions tbody th{font-weight:400}
th.n,td.n{text-align:right;white-space:nowrap}
tr.note td,tr.note th{padding-top:0;color:var(--quiet);font-weight:400;font-size:13px;border-bottom:1px solid var(--rule)}
tr.more th,tr.more td{border-bottom:0}
td:last-child,th:last-child{padding-right:0}
.tag{display:inline-block;padding:0 8px;border-radius:9px;font-size:12.5px;line-height:19px;white-space:nowrap;border:1px solid var(--rule);color:var(--quiet)}
.tag.good{background:var(--good-fill);border-color:transparent;color:var(--good)}
.tag.bad{background:var(--bad-fill);border-color:transparent;color:var(--bad)}
.tag.warn{background:var(--warn-fill);border-color:transparent;color:var(--warn)}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(500px,100%),1fr));gap:14px 20px;align-items:start}
figure{margin:0;min-width:0}
figure.wide{grid-column:1/-1;overflow-x:auto}
figure svg{display:block;max-width:100%;height:auto}
@media screen{figure.wide svg{min-width:720px}}
figure svg text{font-family:system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
figcaption{margin:4px 0 10px;color:var(--quiet);font-size:13.5px;max-width:78ch;overflow-wrap:anywhere}
.problem{padding:18px;background:var(--panel);border:1px dashed var(--rule);color:var(--quiet)}
ul{margin:8px 0;padding-left:20px}
li{margin:3px 0;max-width:90ch;overflow-wrap:anywhere}
pre{margin:6px 0 12px;padding:10px 12px;background:var(--panel);border:1px solid var(--rule);border-radius:3px;overflow-x:auto;font-size:13px;line-height:1.45}
code{font-family:ui-monospace,SFMono-Regular,Menlo,Consolas,"DejaVu Sans Mono",monospace}
summary{margin:10px 0;cursor:pointer;color:var(--series-1)}
footer{margin-top:44px;padding-bottom:40px;color:var(--quiet);font-size:13px}
@media print{
@page{size:A4;margin:13mm}
main,header.page,footer{padding:0;max-width:none}
header.page{padding:0}
body{font-size:9.5pt}
table{font-size:8pt}
thead th,caption,tr.note td,.tag{font-size:7.5pt}
th,td{padding:3.5px 9px 3.5px 0}
td:last-child:not(.n){min-width:0}
.tag{padding:0 5px;line-height:14px}
.scroll{overflow:visible}
figcaption{font-size:8.5pt}
h2{margin-top:24px}
nav{display:none}
figure,table,tr,pre{break-inside:avoid}
h2,h3{break-after:avoid}
pre{white-space:pre-wrap;overflow-wrap:anywhere}
.figures{grid-template-columns:1fr 1fr}
*{-webkit-print-color-adjust:exact;print-color-adjust:exact}
}
)";
}

}  // namespace bondlab
