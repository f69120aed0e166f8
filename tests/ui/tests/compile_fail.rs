//! The macro's whole path: errors as users see them, and calls that must compile.

#[test]
fn errors_as_users_see_them() {
    let cases = trybuild::TestCases::new();
    cases.compile_fail("fail/*.rs");
    cases.pass("pass/*.rs");
}
