//! `report.html`: one self-contained page, readable without JavaScript.
