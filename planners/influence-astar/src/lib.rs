//! A* over influence regions and risk (Wang & Zhu 2018).
