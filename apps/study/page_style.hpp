// SPDX-License-Identifier: MIT
#pragma once

// The style of the page. Plots keep their tones in the light and on paper; in the dark the meaningful ones (drawing.hpp) and the
// colours that would drown are exchanged, by their value.

namespace study {

inline constexpr const char* page_style = R"~(
:root{--paper:#fff;--ink:#222;--pale:#666;--faint:#ddd;--strong:#f0f4f8}
*{box-sizing:border-box}
body{margin:0 auto;padding:28px 24px 60px;max-width:1120px;color:var(--ink);background:var(--paper);
 font:16px/1.5 Georgia,'Liberation Serif','DejaVu Serif',serif}
h1{font-size:30px;line-height:1.2;margin:0 0 6px}
h2{font-size:23px;margin:48px 0 4px;padding-top:14px;border-top:2px solid var(--ink)}
h3{font-size:17px;margin:30px 0 6px}
p{margin:8px 0;max-width:46em}
.difficulty{font-style:italic;color:var(--pale);margin-top:0}
dl{display:grid;grid-template-columns:max-content 1fr;gap:2px 16px;margin:14px 0;font-size:15px}
dt{color:var(--pale)}dd{margin:0}
nav ul,.findings,.omitted{padding-left:22px;margin:8px 0}
a{color:inherit}
figure{margin:18px 0;break-inside:avoid}
figure svg{display:block;width:100%;height:auto;max-width:820px}
figcaption{font-size:14.5px;color:var(--pale);max-width:52em;margin-top:4px}
figcaption b,caption b{color:var(--ink)}
.maps{display:grid;grid-template-columns:repeat(3,1fr);gap:14px}
.maps figure{margin:0}.maps img{display:block;width:100%;height:auto}
.maps figcaption{font-size:13px;line-height:1.35}
.scale svg{max-width:480px}
.scroll{overflow-x:auto;margin:16px 0}
table{border-collapse:collapse;font:13px/1.35 'Helvetica Neue',Arial,'Liberation Sans',sans-serif;font-variant-numeric:tabular-nums;
 border-top:1.5px solid var(--ink);border-bottom:1.5px solid var(--ink)}
caption{text-align:left;font:14.5px/1.45 Georgia,'Liberation Serif','DejaVu Serif',serif;color:var(--pale);padding-bottom:6px;max-width:66em}
th{font-weight:600;vertical-align:bottom;border-bottom:1px solid var(--ink)}
th,td{padding:2px 6px;text-align:right}td{white-space:nowrap}
th.name,td.name{text-align:left}
td.name{white-space:normal}
.wide table{font-size:12px}.wide th,.wide td{padding:2px 3px}
tr.begins td{border-top:1px solid var(--faint)}
tr.front td:nth-child(2)::after{content:' \2605'}
tr.front td{background:var(--strong)}
td.best{font-weight:bold}
td.remark{text-align:left;white-space:normal;font-style:italic;color:var(--pale)}
@media screen and (max-width:760px){.maps{grid-template-columns:1fr 1fr}dl{grid-template-columns:1fr}}
@media screen and (prefers-color-scheme:dark){
 :root{--paper:#16181b;--ink:#e8e8e4;--pale:#a2a29c;--faint:#3a3d42;--strong:#22282f}
 svg [fill="#222222"]{fill:var(--ink)}svg [stroke="#222222"]{stroke:var(--ink)}
 svg [fill="#ffffff"]{fill:var(--paper)}svg [stroke="#ffffff"]{stroke:var(--paper)}
 svg [fill="#666666"]{fill:var(--pale)}svg [stroke="#dddddd"]{stroke:var(--faint)}
 svg [fill="#000000"]{fill:#fff}svg [stroke="#000000"]{stroke:#fff}
 svg [fill="#0072b2"]{fill:#3f9fdd}svg [stroke="#0072b2"]{stroke:#3f9fdd}
 svg [opacity="0.16"]{opacity:.3}
}
@media print{
 @page{size:A4;margin:15mm 14mm}
 @page wide{size:A4 landscape;margin:13mm 12mm}
 body{padding:0;max-width:none;font-size:10.5pt}
 h2{break-before:page;margin-top:0;border-top:0}
 h2.first{break-before:auto}
 h3{break-after:avoid}
 .wide{page:wide}
 figure svg{max-width:170mm}
 .scroll{overflow:visible}
 table,.wide table{font-size:7pt}.summary table{font-size:7.5pt;break-inside:avoid}th,td,.wide th,.wide td{padding:1px 3px}
 thead{display:table-header-group}tr{break-inside:avoid}tr:not(.begins){break-before:avoid}
 caption{font-size:9.5pt}figcaption{font-size:9.5pt}.maps figcaption{font-size:8.5pt}
 tr.front td{background:none}
 nav{display:none}
}
)~";

}  // namespace study
