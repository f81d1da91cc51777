Shader "Nature/Foliage Hashed (Surface)"
{
    Properties
    {
        _Color ("Main Color", Color) = (1,1,1,1)
        _MainTex ("Base (RGB) Alpha (A)", 2D) = "white" {}
        [Normal] _BumpMap ("Normal", 2D) = "bump" {}
        _HashScale ("Hash Scale", Range(0.25, 4)) = 1
        _Gloss ("Smoothness", Range(0,1)) = 0.2
    }
    SubShader
    {
        Tags { "Queue"="AlphaTest" "RenderType"="TransparentCutout" "IgnoreProjector"="True" }
        LOD 300
        Cull Off

        CGPROGRAM
        #pragma surface surf Standard vertex:vert addshadow fullforwardshadows
        #pragma target 3.0
        #include "UnityCG.cginc"

        sampler2D _MainTex;
        sampler2D _BumpMap;
        fixed4 _Color;
        half _Gloss;
        float _HashScale;

        struct Input
        {
            float2 uv_MainTex;
            float2 uv_BumpMap;
            float3 objPos;
        };

        void vert (inout appdata_full v, out Input o)
        {
            UNITY_INITIALIZE_OUTPUT(Input, o);
            o.objPos = v.vertex.xyz;
        }

        inline float hash21 (float2 i) { return frac(1.0e4 * sin(17.0*i.x + 0.1*i.y) * (0.1 + abs(sin(13.0*i.y + i.x)))); }
        inline float hash31 (float3 i) { return hash21(float2(hash21(i.xy), i.z)); }

        void surf (Input IN, inout SurfaceOutputStandard o)
        {
            fixed4 c = tex2D(_MainTex, IN.uv_MainTex) * _Color;

            float3 op = IN.objPos;
            float3 aniso = max(abs(ddx(op)), abs(ddy(op)));
            float3 sc = 0.707 / (_HashScale * aniso);
            float3 sl = log2(sc);
            float3 s0 = exp2(floor(sl));
            float3 s1 = exp2(ceil(sl));
            float2 al = float2(hash31(floor(s0 * op)), hash31(floor(s1 * op)));
            float3 fl = frac(sl);
            float2 toCorners = float2(length(fl), length(1.0 - fl));
            float f = toCorners.x / (toCorners.x + toCorners.y);
            float x = (1 - f) * al.x + f * al.y;
            float a = min(f, 1 - f);
            float3 cases = float3(x*x/(2*a*(1-a)), (x-0.5*a)/(1-a), 1.0-((1-x)*(1-x)/(2*a*(1-a))));
            float thr = (x < (1-a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
            thr = clamp(thr, 1.0e-6, 1.0);
            clip(c.a - thr);

            o.Albedo = c.rgb;
            o.Normal = UnpackNormal(tex2D(_BumpMap, IN.uv_BumpMap));
            o.Smoothness = _Gloss;
            o.Metallic = 0;
            o.Alpha = 1;
        }
        ENDCG
    }
    FallBack "Transparent/Cutout/VertexLit"
}
