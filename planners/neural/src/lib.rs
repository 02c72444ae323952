//! Bio-inspired shunting neural network.
