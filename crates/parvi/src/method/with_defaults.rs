//! Structs whose fields have their defaults beside them.

/// `with_defaults! { pub struct Options { pub steps: Option<usize> = None, } }` is the struct and its `Default`.
macro_rules! with_defaults {
    ($(#[$about:meta])* pub struct $name:ident { $($(#[$meta:meta])* pub $field:ident: $type:ty = $default:expr,)* }) => {
        $(#[$about])*
        pub struct $name {
            $($(#[$meta])* pub $field: $type,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self {
                    $($field: $default,)*
                }
            }
        }
    };
}
pub(crate) use with_defaults;
