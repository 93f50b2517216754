# SPDX-License-Identifier: MIT
#
# What the page is made of. The scripts become one module, in this order: sections, and last what calls them.
set(page_html page.html)
set(page_css page.css)
set(page_js script/base.js script/masthead.js script/summary.js script/show.js script/ways.js script/flight.js
            script/close_ups.js script/claims.js script/records.js script/method.js script/main.js)
