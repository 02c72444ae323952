//! The parts of SSL-Vision and referee messages that make scenes (protobuf, proto2;
//! mm, s). Fields that are left out are passed over; `required` ones are optional
//! here, so that their absence can be told from 0.

use prost::Message;

/// One datagram of SSL-Vision.
#[derive(Clone, PartialEq, Message)]
pub(super) struct WrapperPacket {
    #[prost(message, optional, tag = "1")]
    pub detection: Option<DetectionFrame>,
    #[prost(message, optional, tag = "2")]
    pub geometry: Option<GeometryData>,
}

/// What one camera saw.
#[derive(Clone, PartialEq, Message)]
pub(super) struct DetectionFrame {
    #[prost(double, optional, tag = "2")]
    pub t_capture: Option<f64>,
    #[prost(uint32, optional, tag = "4")]
    pub camera_id: Option<u32>,
    #[prost(message, repeated, tag = "6")]
    pub robots_yellow: Vec<DetectionRobot>,
    #[prost(message, repeated, tag = "7")]
    pub robots_blue: Vec<DetectionRobot>,
}

#[derive(Clone, PartialEq, Message)]
pub(super) struct DetectionRobot {
    #[prost(float, optional, tag = "1")]
    pub confidence: Option<f32>,
    #[prost(uint32, optional, tag = "2")]
    pub robot_id: Option<u32>,
    #[prost(float, optional, tag = "3")]
    pub x: Option<f32>,
    #[prost(float, optional, tag = "4")]
    pub y: Option<f32>,
}

#[derive(Clone, PartialEq, Message)]
pub(super) struct GeometryData {
    #[prost(message, optional, tag = "1")]
    pub field: Option<GeometryFieldSize>,
}

#[derive(Clone, PartialEq, Message)]
pub(super) struct GeometryFieldSize {
    #[prost(int32, optional, tag = "1")]
    pub field_length: Option<i32>,
    #[prost(int32, optional, tag = "2")]
    pub field_width: Option<i32>,
    #[prost(int32, optional, tag = "5")]
    pub boundary_width: Option<i32>,
    #[prost(message, repeated, tag = "6")]
    pub field_lines: Vec<FieldLineSegment>,
    #[prost(float, optional, tag = "15")]
    pub max_robot_radius: Option<f32>,
}

#[derive(Clone, PartialEq, Message)]
pub(super) struct FieldLineSegment {
    #[prost(string, optional, tag = "1")]
    pub name: Option<String>,
    #[prost(message, optional, tag = "2")]
    pub p1: Option<Vector2f>,
    #[prost(message, optional, tag = "3")]
    pub p2: Option<Vector2f>,
}

#[derive(Clone, Copy, PartialEq, Message)]
pub(super) struct Vector2f {
    #[prost(float, optional, tag = "1")]
    pub x: Option<f32>,
    #[prost(float, optional, tag = "2")]
    pub y: Option<f32>,
}

/// The referee's box.
#[derive(Clone, Copy, PartialEq, Message)]
pub(super) struct Referee {
    #[prost(bool, optional, tag = "10")]
    pub blue_team_on_positive_half: Option<bool>,
}
