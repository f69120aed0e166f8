//! The table of joint kinds agrees with itself.

use multibody_engine::model::joint_kinds::{ALL, JointKind};

#[test]
fn a_joint_holds_what_it_does_not_leave_free() {
    for kind in ALL {
        assert_eq!(kind.rows().count() + kind.freedoms(), 6, "{}", kind.name);
    }
}

#[test]
fn every_name_leads_to_its_row() {
    let names: Vec<&str> = JointKind::names().collect();
    for kind in ALL {
        assert_eq!(JointKind::named(kind.name).map(|found| found.name), Some(kind.name));
        assert_eq!(names.iter().filter(|name| **name == kind.name).count(), 1, "{}", kind.name);
        for elsewhere in kind.elsewhere {
            assert_eq!(JointKind::elsewhere(elsewhere).map(|found| found.name), Some(kind.name), "{elsewhere}");
            assert!(JointKind::named(elsewhere).is_none(), "{elsewhere}");
        }
        if let Some(orientation) = kind.orientation {
            assert_eq!(kind.oriented(orientation), Some(kind));
        }
    }
}

#[test]
fn several_scalars_have_a_struct() {
    for kind in ALL {
        let needed = kind.freedoms() > 1 && !kind.has_quaternion() && !kind.is_free();
        assert_eq!(!kind.struct_name.is_empty(), needed, "{}", kind.name);
        assert!(kind.freedoms.iter().all(|freedom| freedom.direction < 3), "{}", kind.name);
    }
}
